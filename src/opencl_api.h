/* opencl_api.h - the part of OpenCL 1.2 that lobe calls, loaded at run time.
 *
 * Nothing links with OpenCL and its headers are not needed: one binary serves with and without a runtime. The names and
 * values are those of the Khronos headers. */
#ifndef LOBE_OPENCL_API_H
#define LOBE_OPENCL_API_H

#include <stddef.h>
#include <stdint.h>

#include "lobe/batch.h"

typedef int32_t cl_int;
typedef uint32_t cl_uint;
typedef uint64_t cl_ulong;
typedef cl_uint cl_bool;
typedef cl_ulong cl_bitfield;
typedef intptr_t cl_context_properties;

typedef struct _cl_platform_id *cl_platform_id;
typedef struct _cl_device_id *cl_device_id;
typedef struct _cl_context *cl_context;
typedef struct _cl_command_queue *cl_command_queue;
typedef struct _cl_mem *cl_mem;
typedef struct _cl_program *cl_program;
typedef struct _cl_kernel *cl_kernel;
typedef struct _cl_event *cl_event;

/* Error codes, by LOBE_CL_ERROR(name, value); the table that messages name them from. */
#define LOBE_CL_ERRORS(LOBE_CL_ERROR)                                                                                  \
	LOBE_CL_ERROR(CL_DEVICE_NOT_FOUND, -1)                                                                         \
	LOBE_CL_ERROR(CL_DEVICE_NOT_AVAILABLE, -2)                                                                     \
	LOBE_CL_ERROR(CL_COMPILER_NOT_AVAILABLE, -3)                                                                   \
	LOBE_CL_ERROR(CL_MEM_OBJECT_ALLOCATION_FAILURE, -4)                                                            \
	LOBE_CL_ERROR(CL_OUT_OF_RESOURCES, -5)                                                                         \
	LOBE_CL_ERROR(CL_OUT_OF_HOST_MEMORY, -6)                                                                       \
	LOBE_CL_ERROR(CL_PROFILING_INFO_NOT_AVAILABLE, -7)                                                             \
	LOBE_CL_ERROR(CL_MEM_COPY_OVERLAP, -8)                                                                         \
	LOBE_CL_ERROR(CL_IMAGE_FORMAT_MISMATCH, -9)                                                                    \
	LOBE_CL_ERROR(CL_IMAGE_FORMAT_NOT_SUPPORTED, -10)                                                              \
	LOBE_CL_ERROR(CL_BUILD_PROGRAM_FAILURE, -11)                                                                   \
	LOBE_CL_ERROR(CL_MAP_FAILURE, -12)                                                                             \
	LOBE_CL_ERROR(CL_MISALIGNED_SUB_BUFFER_OFFSET, -13)                                                            \
	LOBE_CL_ERROR(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, -14)                                               \
	LOBE_CL_ERROR(CL_COMPILE_PROGRAM_FAILURE, -15)                                                                 \
	LOBE_CL_ERROR(CL_LINKER_NOT_AVAILABLE, -16)                                                                    \
	LOBE_CL_ERROR(CL_LINK_PROGRAM_FAILURE, -17)                                                                    \
	LOBE_CL_ERROR(CL_INVALID_VALUE, -30)                                                                           \
	LOBE_CL_ERROR(CL_INVALID_DEVICE_TYPE, -31)                                                                     \
	LOBE_CL_ERROR(CL_INVALID_PLATFORM, -32)                                                                        \
	LOBE_CL_ERROR(CL_INVALID_DEVICE, -33)                                                                          \
	LOBE_CL_ERROR(CL_INVALID_CONTEXT, -34)                                                                         \
	LOBE_CL_ERROR(CL_INVALID_QUEUE_PROPERTIES, -35)                                                                \
	LOBE_CL_ERROR(CL_INVALID_COMMAND_QUEUE, -36)                                                                   \
	LOBE_CL_ERROR(CL_INVALID_HOST_PTR, -37)                                                                        \
	LOBE_CL_ERROR(CL_INVALID_MEM_OBJECT, -38)                                                                      \
	LOBE_CL_ERROR(CL_INVALID_BINARY, -42)                                                                          \
	LOBE_CL_ERROR(CL_INVALID_BUILD_OPTIONS, -43)                                                                   \
	LOBE_CL_ERROR(CL_INVALID_PROGRAM, -44)                                                                         \
	LOBE_CL_ERROR(CL_INVALID_PROGRAM_EXECUTABLE, -45)                                                              \
	LOBE_CL_ERROR(CL_INVALID_KERNEL_NAME, -46)                                                                     \
	LOBE_CL_ERROR(CL_INVALID_KERNEL_DEFINITION, -47)                                                               \
	LOBE_CL_ERROR(CL_INVALID_KERNEL, -48)                                                                          \
	LOBE_CL_ERROR(CL_INVALID_ARG_INDEX, -49)                                                                       \
	LOBE_CL_ERROR(CL_INVALID_ARG_VALUE, -50)                                                                       \
	LOBE_CL_ERROR(CL_INVALID_ARG_SIZE, -51)                                                                        \
	LOBE_CL_ERROR(CL_INVALID_KERNEL_ARGS, -52)                                                                     \
	LOBE_CL_ERROR(CL_INVALID_WORK_DIMENSION, -53)                                                                  \
	LOBE_CL_ERROR(CL_INVALID_WORK_GROUP_SIZE, -54)                                                                 \
	LOBE_CL_ERROR(CL_INVALID_WORK_ITEM_SIZE, -55)                                                                  \
	LOBE_CL_ERROR(CL_INVALID_GLOBAL_OFFSET, -56)                                                                   \
	LOBE_CL_ERROR(CL_INVALID_EVENT_WAIT_LIST, -57)                                                                 \
	LOBE_CL_ERROR(CL_INVALID_EVENT, -58)                                                                           \
	LOBE_CL_ERROR(CL_INVALID_OPERATION, -59)                                                                       \
	LOBE_CL_ERROR(CL_INVALID_BUFFER_SIZE, -61)                                                                     \
	LOBE_CL_ERROR(CL_INVALID_GLOBAL_WORK_SIZE, -63)                                                                \
	LOBE_CL_ERROR(CL_INVALID_PROPERTY, -64)                                                                        \
	LOBE_CL_ERROR(CL_INVALID_COMPILER_OPTIONS, -66)                                                                \
	LOBE_CL_ERROR(CL_PLATFORM_NOT_FOUND_KHR, -1001)

enum {
	CL_SUCCESS = 0,
#define LOBE_CL_ERROR(name, value) name = value,
	LOBE_CL_ERRORS(LOBE_CL_ERROR)
#undef LOBE_CL_ERROR

		CL_FALSE = 0,
	CL_TRUE = 1,

	CL_PLATFORM_VERSION = 0x0901,
	CL_PLATFORM_NAME = 0x0902,
	CL_DEVICE_TYPE = 0x1000,
	CL_DEVICE_MAX_COMPUTE_UNITS = 0x1002,
	CL_DEVICE_MAX_WORK_GROUP_SIZE = 0x1004,
	CL_DEVICE_MAX_MEM_ALLOC_SIZE = 0x1010,
	CL_DEVICE_SINGLE_FP_CONFIG = 0x101B,
	CL_DEVICE_GLOBAL_MEM_SIZE = 0x101F,
	CL_DEVICE_ENDIAN_LITTLE = 0x1026,
	CL_DEVICE_AVAILABLE = 0x1027,
	CL_DEVICE_COMPILER_AVAILABLE = 0x1028,
	CL_DEVICE_NAME = 0x102B,
	CL_DRIVER_VERSION = 0x102D,
	CL_DEVICE_VERSION = 0x102F,
	CL_DEVICE_PLATFORM = 0x1031,
	CL_DEVICE_HOST_UNIFIED_MEMORY = 0x1035,
	CL_CONTEXT_PLATFORM = 0x1084,
	CL_QUEUE_CONTEXT = 0x1090,
	CL_QUEUE_DEVICE = 0x1091,
	CL_QUEUE_PROPERTIES = 0x1093,
	CL_MEM_TYPE = 0x1100,
	CL_MEM_FLAGS = 0x1101,
	CL_MEM_SIZE = 0x1102,
	CL_MEM_CONTEXT = 0x1106,
	CL_PROGRAM_BINARY_SIZES = 0x1165,
	CL_PROGRAM_BINARIES = 0x1166,
	CL_PROGRAM_BUILD_LOG = 0x1183,
	CL_KERNEL_WORK_GROUP_SIZE = 0x11B0
};

#define CL_DEVICE_TYPE_CPU ((cl_bitfield)1 << 1)
#define CL_DEVICE_TYPE_ALL ((cl_bitfield)0xFFFFFFFF)

/* CL_DEVICE_SINGLE_FP_CONFIG */
#define CL_FP_DENORM                        ((cl_bitfield)1 << 0)
#define CL_FP_INF_NAN                       ((cl_bitfield)1 << 1)
#define CL_FP_ROUND_TO_NEAREST              ((cl_bitfield)1 << 2)
#define CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT ((cl_bitfield)1 << 7)

#define CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE ((cl_bitfield)1 << 0)

#define CL_MEM_READ_WRITE    ((cl_bitfield)1 << 0)
#define CL_MEM_WRITE_ONLY    ((cl_bitfield)1 << 1)
#define CL_MEM_READ_ONLY     ((cl_bitfield)1 << 2)
#define CL_MEM_OBJECT_BUFFER 0x10F0u
#define CL_MEM_USE_HOST_PTR  ((cl_bitfield)1 << 3)
#define CL_MEM_COPY_HOST_PTR ((cl_bitfield)1 << 5)

#define CL_MAP_READ                    ((cl_bitfield)1 << 0)
#define CL_MAP_WRITE_INVALIDATE_REGION ((cl_bitfield)1 << 2)

/* Every function used: LOBE_CL_FUNCTION(result, name, arguments) */
#define LOBE_CL_FUNCTIONS(LOBE_CL_FUNCTION)                                                                            \
	LOBE_CL_FUNCTION(cl_int, clGetPlatformIDs, (cl_uint, cl_platform_id *, cl_uint *))                             \
	LOBE_CL_FUNCTION(cl_int, clGetPlatformInfo, (cl_platform_id, cl_uint, size_t, void *, size_t *))               \
	LOBE_CL_FUNCTION(cl_int, clGetDeviceIDs, (cl_platform_id, cl_bitfield, cl_uint, cl_device_id *, cl_uint *))    \
	LOBE_CL_FUNCTION(cl_int, clGetDeviceInfo, (cl_device_id, cl_uint, size_t, void *, size_t *))                   \
	LOBE_CL_FUNCTION(cl_int, clRetainDevice, (cl_device_id))                                                       \
	LOBE_CL_FUNCTION(cl_int, clReleaseDevice, (cl_device_id))                                                      \
	LOBE_CL_FUNCTION(cl_context, clCreateContext,                                                                  \
			 (const cl_context_properties *, cl_uint, const cl_device_id *,                                \
			  void (*)(const char *, const void *, size_t, void *), void *, cl_int *))                     \
	LOBE_CL_FUNCTION(cl_int, clRetainContext, (cl_context))                                                        \
	LOBE_CL_FUNCTION(cl_int, clReleaseContext, (cl_context))                                                       \
	LOBE_CL_FUNCTION(cl_command_queue, clCreateCommandQueue, (cl_context, cl_device_id, cl_bitfield, cl_int *))    \
	LOBE_CL_FUNCTION(cl_int, clGetCommandQueueInfo, (cl_command_queue, cl_uint, size_t, void *, size_t *))         \
	LOBE_CL_FUNCTION(cl_int, clRetainCommandQueue, (cl_command_queue))                                             \
	LOBE_CL_FUNCTION(cl_int, clReleaseCommandQueue, (cl_command_queue))                                            \
	LOBE_CL_FUNCTION(cl_program, clCreateProgramWithSource,                                                        \
			 (cl_context, cl_uint, const char **, const size_t *, cl_int *))                               \
	LOBE_CL_FUNCTION(cl_program, clCreateProgramWithBinary,                                                        \
			 (cl_context, cl_uint, const cl_device_id *, const size_t *, const unsigned char **, cl_int *, \
			  cl_int *))                                                                                   \
	LOBE_CL_FUNCTION(cl_int, clGetProgramInfo, (cl_program, cl_uint, size_t, void *, size_t *))                    \
	LOBE_CL_FUNCTION(                                                                                              \
		cl_int, clBuildProgram,                                                                                \
		(cl_program, cl_uint, const cl_device_id *, const char *, void (*)(cl_program, void *), void *))       \
	LOBE_CL_FUNCTION(cl_int, clGetProgramBuildInfo, (cl_program, cl_device_id, cl_uint, size_t, void *, size_t *)) \
	LOBE_CL_FUNCTION(cl_int, clReleaseProgram, (cl_program))                                                       \
	LOBE_CL_FUNCTION(cl_kernel, clCreateKernel, (cl_program, const char *, cl_int *))                              \
	LOBE_CL_FUNCTION(cl_int, clSetKernelArg, (cl_kernel, cl_uint, size_t, const void *))                           \
	LOBE_CL_FUNCTION(cl_int, clGetKernelWorkGroupInfo,                                                             \
			 (cl_kernel, cl_device_id, cl_uint, size_t, void *, size_t *))                                 \
	LOBE_CL_FUNCTION(cl_int, clReleaseKernel, (cl_kernel))                                                         \
	LOBE_CL_FUNCTION(cl_mem, clCreateBuffer, (cl_context, cl_bitfield, size_t, void *, cl_int *))                  \
	LOBE_CL_FUNCTION(cl_int, clGetMemObjectInfo, (cl_mem, cl_uint, size_t, void *, size_t *))                      \
	LOBE_CL_FUNCTION(cl_int, clReleaseMemObject, (cl_mem))                                                         \
	LOBE_CL_FUNCTION(                                                                                              \
		cl_int, clEnqueueReadBuffer,                                                                           \
		(cl_command_queue, cl_mem, cl_bool, size_t, size_t, void *, cl_uint, const cl_event *, cl_event *))    \
	LOBE_CL_FUNCTION(cl_int, clEnqueueWriteBuffer,                                                                 \
			 (cl_command_queue, cl_mem, cl_bool, size_t, size_t, const void *, cl_uint, const cl_event *,  \
			  cl_event *))                                                                                 \
	LOBE_CL_FUNCTION(void *, clEnqueueMapBuffer,                                                                   \
			 (cl_command_queue, cl_mem, cl_bool, cl_bitfield, size_t, size_t, cl_uint, const cl_event *,   \
			  cl_event *, cl_int *))                                                                       \
	LOBE_CL_FUNCTION(cl_int, clEnqueueUnmapMemObject,                                                              \
			 (cl_command_queue, cl_mem, void *, cl_uint, const cl_event *, cl_event *))                    \
	LOBE_CL_FUNCTION(cl_int, clEnqueueNDRangeKernel,                                                               \
			 (cl_command_queue, cl_kernel, cl_uint, const size_t *, const size_t *, const size_t *,        \
			  cl_uint, const cl_event *, cl_event *))                                                      \
	LOBE_CL_FUNCTION(cl_int, clFlush, (cl_command_queue))                                                          \
	LOBE_CL_FUNCTION(cl_int, clFinish, (cl_command_queue))

typedef struct {
#define LOBE_CL_FUNCTION(result, name, arguments) result(*name) arguments;
	LOBE_CL_FUNCTIONS(LOBE_CL_FUNCTION)
#undef LOBE_CL_FUNCTION
} lobe_cl_functions;

/* The functions, loaded by the first call; NULL without a runtime. Thread-safe. */
const lobe_cl_functions *lobe_cl_load(void);

/* Why lobe_cl_load gave NULL, for a message. */
const char *lobe_cl_load_error(void);

/* The failure of an OpenCL call as a status, with a message that names both: lobe_cl_fail("clFinish", error). */
lobe_status lobe_cl_fail(const char *call, cl_int error);

/* The name of an error code; "unknown error" of one that has none here. */
const char *lobe_cl_error_name(cl_int error);

#endif
