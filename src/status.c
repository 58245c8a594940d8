/* status.c - names of statuses and this thread's error message. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "internal.h"

/* Room for the head of an OpenCL build log. */
static __thread char message[sizeof((lobe_message *)0)->text];

const char *lobe_status_string(lobe_status status)
{
	switch (status) {
	case LOBE_OK:
		return "LOBE_OK";
	case LOBE_ERROR_ARGUMENT:
		return "LOBE_ERROR_ARGUMENT";
	case LOBE_ERROR_PARAMETER:
		return "LOBE_ERROR_PARAMETER";
	case LOBE_ERROR_DEVICE:
		return "LOBE_ERROR_DEVICE";
	case LOBE_ERROR_BUILD:
		return "LOBE_ERROR_BUILD";
	case LOBE_ERROR_MEMORY:
		return "LOBE_ERROR_MEMORY";
	case LOBE_ERROR_OPENCL:
		return "LOBE_ERROR_OPENCL";
	}
	return "unknown status";
}

const char *lobe_error_message(void) { return message; }

void lobe_message_get(lobe_message *out) { memcpy(out->text, message, strlen(message) + 1); }

void lobe_message_set(const lobe_message *from) { memcpy(message, from->text, strlen(from->text) + 1); }

void lobe_set_error_message(const char *format, ...)
{
	va_list args;
	va_start(args, format);
	vsnprintf(message, sizeof message, format, args);
	va_end(args);
}

lobe_status lobe_out_of_memory(const char *what) { return lobe_fail(LOBE_ERROR_MEMORY, "out of memory for %s", what); }
