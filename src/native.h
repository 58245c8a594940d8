/* native.h - what the parts of the native backend share: native.c (devices, instruction sets, threads), native_chunk.c
 * (one chunk of a batch on one thread), rows.c (the loops), native_split.c (mixed lobes). */
#ifndef LOBE_NATIVE_H
#define LOBE_NATIVE_H

#include "rows.h"
#include "native_split.h"

/* The most elements of a chunk: a thread that is put aside with one in hand keeps the others waiting so long. */
#define LOBE_NATIVE_CHUNK 65536
/* Nanoseconds of shading up to which a batch stays on the caller's thread: below, waking another costs more than it
 * saves. (bench/throughput --only scaling shows where.) */
#ifndef LOBE_NATIVE_ALONE
#define LOBE_NATIVE_ALONE 32000.0
#endif
/* Elements that go through a thread's own memory at a time where nothing is mixed: their arrays stay in the first-level
 * cache. */
#define LOBE_NATIVE_BLOCK 256

/* Bytes of outputs from which mixed batches are written past the caches: no cache would keep them for their reader. */
#ifndef LOBE_NATIVE_STREAM
#define LOBE_NATIVE_STREAM ((size_t)16 << 20)
#endif

/* scene->state: the key by which elements are split, materials of a lobe side by side, or lobes. */
typedef struct {
	int single; /* the only lobe, or -1 */
	int by_material;
	uint32_t keys;
	uint32_t first_key[LOBE_COUNT + 2]; /* lobe L has the keys [first_key[L], first_key[L + 1]) */
	uint32_t key[];                     /* of each material */
} lobe_native_scene;

/* A thread's own memory: elements of a block, packed; and sorted by key. */
typedef struct {
	lobe_native_places places;
	uint32_t material[LOBE_NATIVE_SPLIT_MAX], slots[LOBE_NATIVE_SPLIT_MAX];
	uint32_t slot[LOBE_NATIVE_SPLIT_ROOM] LOBE_NATIVE_ALIGNED;
	float packed_in[LOBE_IN_COUNT][LOBE_NATIVE_SPLIT_MAX] LOBE_NATIVE_ALIGNED;
	float in[LOBE_IN_COUNT][LOBE_NATIVE_SPLIT_ROOM] LOBE_NATIVE_ALIGNED;
	float packed_out[LOBE_OUT_COUNT][LOBE_NATIVE_SPLIT_MAX] LOBE_NATIVE_ALIGNED;
	float out[LOBE_OUT_COUNT][LOBE_NATIVE_SPLIT_ROOM] LOBE_NATIVE_ALIGNED;
	uint32_t packed_event[LOBE_NATIVE_SPLIT_MAX], event[LOBE_NATIVE_SPLIT_ROOM];
	unsigned char apart[64]; /* the next thread's is in other cache lines */
} lobe_native_scratch;

/* A batch on its way; chunk: elements of each chunk. */
typedef struct {
	const lobe_scene *scene;
	const lobe_job *job;
	const lobe_rows *const *rows;
	const lobe_native_split *split;
	lobe_native_scratch *scratch; /* [threads] */
	size_t chunk;
	int stream;         /* mixed results go past the caches */
	double nanoseconds; /* that an element of the first chunk took, set when it is done */
} lobe_native_job;

/* The only lobe of a batch (LOBE_INDEX_NONE too), or -1. */
int lobe_native_whole(const lobe_scene *scene, const lobe_job *job);

/* Elements of a block of several lobes. */
size_t lobe_native_split_block(const lobe_scene *scene);

/* A lobe_pool_work; context: a lobe_native_job. */
void lobe_native_chunk(void *context, size_t chunk, size_t thread);

/* How a native device sorts, for those who time it. (native.c) */
const lobe_native_split *lobe_native_split_of(const lobe_device *device);

lobe_status lobe_native_scene_create(lobe_scene *scene);
void lobe_native_scene_destroy(lobe_scene *scene);

#endif
