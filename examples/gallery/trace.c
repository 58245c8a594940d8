/* trace.c - see trace.h.
 *
 * A wave of paths advances together, one surface a round:
 *
 *	hit      the rays meet the scene; those that leave it collect the probe's light and end
 *	prepare  for each path left: frame, direction to the viewer, random numbers; a direction drawn from the probe
 *	sample   one batch through lobe: where each path goes on
 *	eval     one batch through lobe: what reaches the viewer of the light drawn from the probe, where it is not
 *	         hidden
 *	finish   both results into the paths; Russian roulette
 *
 * Light from the probe thus arrives twice, by its own sample and by the lobe's, and each is weighted by the power
 * heuristic of Veach 1997 (section 9.2.4). Every path is on its own and its random numbers are a function of pixel,
 * sample and round, so that neither batches nor threads can show in the picture. */
#define _POSIX_C_SOURCE 200809L
#include "trace.h"
#include "progress.h"
#include "random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAVE = 1 << 17, ROULETTE_AFTER = 3 };

struct path {
	struct ray ray;
	lobe_rgb throughput, radiance;
	float pdf; /* with which the lobe drew ray.dir; 0 for a camera ray, which nothing else could have drawn */
	uint32_t pixel, sample;
	size_t slot; /* in the batch of samples */
	int what;    /* hit */
	float distance;
	struct hit hit;
	struct light_sample light;
};

/* Arrays of a batch by name. */
enum { MATERIAL, EVENT, WORDS };
enum { WO, U = WO + 3, WI = U + 3, WEIGHT = WI + 3, PDF = WEIGHT + 3, FLOATS };

struct batch_arrays {
	uint32_t *words[WORDS];
	float *floats[FLOATS];
};

struct wave {
	const struct trace_setup *setup;
	struct film *film;
	uint64_t first; /* camera sample that paths[0] belongs to */
	uint32_t round;
	struct path *paths;
	uint32_t *alive, *lit;             /* paths that go on; paths that the probe's sample may reach */
	uint32_t *chunk_alive, *chunk_lit; /* [chunks] how many of a chunk's were kept, see gather() */
	struct batch_arrays sample, eval;
	void *memory;
};

/* --- film ------------------------------------------------------------------------------------------------------- */

int film_alloc(struct film *film, int width, int height)
{
	film->width = width;
	film->height = height;
	film->samples = 0;
	film->sum = calloc((size_t)width * (size_t)height * 3, sizeof *film->sum);
	return film->sum ? 0 : -1;
}

void film_free(struct film *film)
{
	free(film->sum);
	film->sum = NULL;
}

void film_image(const struct film *film, struct image *image)
{
	const size_t n = (size_t)film->width * (size_t)film->height * 3;
	for (size_t i = 0; i < n; i++)
		image->rgb[i] = (float)(film->sum[i] / (double)(film->samples ? film->samples : 1));
}

/* --- small parts ------------------------------------------------------------------------------------------------ */

static struct random_key key_of(const struct wave *w, const struct path *p)
{
	const struct random_key key = {w->setup->seed, p->pixel, p->sample, w->round};
	return key;
}

/* Weight of the technique with density a where b could have drawn the same. As a ratio: squares would overflow. */
static float power_heuristic(float a, float b)
{
	const float ratio = b / a;
	return a > 0.0f ? 1.0f / (1.0f + ratio * ratio) : 0.0f;
}

static lobe_rgb multiply(lobe_rgb a, lobe_rgb b) { return lobe_rgb_make(a.r * b.r, a.g * b.g, a.b * b.b); }

static lobe_rgb add(lobe_rgb a, lobe_rgb b) { return lobe_rgb_make(a.r + b.r, a.g + b.g, a.b + b.b); }

static lobe_vec3 load(float *const array[3], size_t i) { return lobe_vec3_make(array[0][i], array[1][i], array[2][i]); }

static void store(float *const array[3], size_t i, lobe_vec3 v)
{
	array[0][i] = v.x;
	array[1][i] = v.y;
	array[2][i] = v.z;
}

/* The chunks of a loop have each left what they keep at their own beginning of list: closes the gaps. */
static size_t gather(uint32_t *list, size_t n, const uint32_t *kept)
{
	size_t total = 0;
	for (size_t begin = 0; begin < n; begin += POOL_CHUNK) {
		memmove(list + total, list + begin, kept[begin / POOL_CHUNK] * sizeof *list);
		total += kept[begin / POOL_CHUNK];
	}
	return total;
}

/* --- the steps of a round: each a loop over chunks --------------------------------------------------------------- */

/* u in [0,1) to a density that falls linearly from 0 to both sides, to -1 and 1. */
static float tent(float u) { return u < 0.5f ? lobe_sqrt(2.0f * u) - 1.0f : 1.0f - lobe_sqrt(2.0f * (1.0f - u)); }

/* A new path through a random point of its pixel, with a tent two pixels wide as the filter. */
static void start(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	const int width = w->film->width, height = w->film->height;
	const uint64_t pixels = (uint64_t)width * (uint64_t)height;
	for (size_t i = begin; i < end; i++) {
		struct path *p = &w->paths[i];
		float u[3];
		p->pixel = (uint32_t)((w->first + i) % pixels);
		p->sample = (uint32_t)((w->first + i) / pixels);
		random_spread(key_of(w, p), RANDOM_CAMERA, u);
		const float x = (float)(p->pixel % (uint32_t)width) + 0.5f + tent(u[0]);
		const float y = (float)(p->pixel / (uint32_t)width) + 0.5f + tent(u[1]);
		p->ray = scene_camera_ray(w->setup->scene, 2.0f * x / (float)width - 1.0f,
					  1.0f - 2.0f * y / (float)height, (float)width / (float)height);
		p->throughput = lobe_rgb_make(1.0f, 1.0f, 1.0f);
		p->radiance = lobe_rgb_make(0.0f, 0.0f, 0.0f);
		p->pdf = 0.0f;
		w->alive[i] = (uint32_t)i;
	}
}

static void hit(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	uint32_t kept = 0;
	for (size_t i = begin; i < end; i++) {
		const uint32_t id = w->alive[i];
		struct path *p = &w->paths[id];
		p->what = scene_intersect(&p->ray, &p->distance);
		if (p->what != SCENE_NOTHING) {
			w->alive[begin + kept++] = id;
			continue;
		}
		float light_pdf;
		const lobe_rgb radiance = light_radiance(w->setup->light, p->ray.dir, &light_pdf);
		const float weight = p->pdf > 0.0f ? power_heuristic(p->pdf, light_pdf) : 1.0f;
		p->radiance = add(p->radiance, lobe_rgb_scale(multiply(p->throughput, radiance), weight));
	}
	w->chunk_alive[begin / POOL_CHUNK] = kept;
}

/* Whether light from direction wi can be seen from the surface. */
static int reaches(const struct path *p, lobe_vec3 wi)
{
	/* Into a ball: light through it comes by the lobe's samples alone, since the ball hides its own inside. */
	if (!(lobe_dot(wi, p->hit.frame.n) > 0.0f))
		return 0;
	const struct ray shadow = {p->hit.position, wi, p->what, 0};
	float distance;
	return scene_intersect(&shadow, &distance) == SCENE_NOTHING;
}

static void prepare(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	uint32_t kept = 0;
	for (size_t i = begin; i < end; i++) {
		const uint32_t id = w->alive[i];
		struct path *p = &w->paths[id];
		float u[3], v[3];
		p->hit = scene_hit(&p->ray, p->what, p->distance);
		random_spread(key_of(w, p), RANDOM_LOBE, u);
		random_spread(key_of(w, p), RANDOM_LIGHT, v);
		p->slot = i;
		store(w->sample.floats + WO, i, lobe_frame_to_local(p->hit.frame, lobe_vec3_scale(p->ray.dir, -1.0f)));
		store(w->sample.floats + U, i, lobe_vec3_make(u[0], u[1], u[2]));
		w->sample.words[MATERIAL][i] = p->hit.material;
		p->light = light_draw(w->setup->light, v[0], v[1]);
		if (p->light.pdf > 0.0f && reaches(p, p->light.wi))
			w->lit[begin + kept++] = id;
	}
	w->chunk_lit[begin / POOL_CHUNK] = kept;
}

static void prepare_eval(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	for (size_t i = begin; i < end; i++) {
		const struct path *p = &w->paths[w->lit[i]];
		store(w->eval.floats + WO, i, load(w->sample.floats + WO, p->slot));
		store(w->eval.floats + WI, i, lobe_frame_to_local(p->hit.frame, p->light.wi));
		w->eval.words[MATERIAL][i] = p->hit.material;
	}
}

static void finish_eval(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	for (size_t i = begin; i < end; i++) {
		struct path *p = &w->paths[w->lit[i]];
		const lobe_vec3 f = load(w->eval.floats + WEIGHT, i);
		const float weight = power_heuristic(p->light.pdf, w->eval.floats[PDF][i]) / p->light.pdf;
		const lobe_rgb light = multiply(p->light.radiance, lobe_rgb_make(f.x, f.y, f.z));
		p->radiance = add(p->radiance, lobe_rgb_scale(multiply(p->throughput, light), weight));
	}
}

static void finish_sample(void *context, size_t begin, size_t end)
{
	struct wave *w = context;
	uint32_t kept = 0;
	for (size_t i = begin; i < end; i++) {
		const uint32_t id = w->alive[i];
		struct path *p = &w->paths[id];
		const lobe_vec3 wi = load(w->sample.floats + WI, i), f = load(w->sample.floats + WEIGHT, i);
		const uint32_t event = w->sample.words[EVENT][i];
		if (event == 0)
			continue;
		p->throughput = multiply(p->throughput, lobe_rgb_make(f.x, f.y, f.z));
		const float most = lobe_max(p->throughput.r, lobe_max(p->throughput.g, p->throughput.b));
		/* Not inside glass, where radiance is smaller by eta^2 only until the path leaves it again. */
		const int inside = p->what != SCENE_GROUND && wi.z < 0.0f;
		if (w->round > ROULETTE_AFTER && !inside) {
			const float survival = lobe_min(most, 0.95f);
			if (random_plain(key_of(w, p), RANDOM_ROULETTE) >= survival)
				continue;
			p->throughput = lobe_rgb_scale(p->throughput, 1.0f / survival);
		} else if (!(most > 0.0f))
			continue;
		/* A delta lobe cannot be hit by the light's sample, which is what pdf 0 says here. */
		p->pdf = event & LOBE_EVENT_DELTA ? 0.0f : w->sample.floats[PDF][i];
		p->ray.origin = p->hit.position;
		p->ray.dir = lobe_normalize(lobe_frame_to_world(p->hit.frame, wi));
		p->ray.from = p->what;
		p->ray.inside = inside;
		w->alive[begin + kept++] = id;
	}
	w->chunk_alive[begin / POOL_CHUNK] = kept;
}

/* --- a wave ------------------------------------------------------------------------------------------------------ */

static int run_batches(struct wave *w, size_t alive, size_t lit, struct trace_stats *stats, char *message, size_t size)
{
	lobe_batch sample, eval;
	memset(&sample, 0, sizeof sample);
	memset(&eval, 0, sizeof eval);
	sample.count = alive;
	sample.material = w->sample.words[MATERIAL];
	sample.event = w->sample.words[EVENT];
	sample.sample_pdf = w->sample.floats[PDF];
	eval.count = lit;
	eval.material = w->eval.words[MATERIAL];
	eval.pdf = w->eval.floats[PDF];
	for (int k = 0; k < 3; k++) {
		sample.wo[k] = w->sample.floats[WO + k];
		sample.u[k] = w->sample.floats[U + k];
		sample.sample_wi[k] = w->sample.floats[WI + k];
		sample.weight[k] = w->sample.floats[WEIGHT + k];
		eval.wo[k] = w->eval.floats[WO + k];
		eval.wi[k] = w->eval.floats[WI + k];
		eval.f[k] = w->eval.floats[WEIGHT + k];
	}
	const double before = seconds_now();
	lobe_status status = lobe_scene_sample(w->setup->materials, &sample);
	if (status == LOBE_OK)
		status = lobe_scene_eval(w->setup->materials, &eval);
	stats->lobe_seconds += seconds_now() - before;
	stats->queries += alive + lit;
	if (status == LOBE_OK)
		return 0;
	snprintf(message, size, "%s: %s", lobe_status_string(status), lobe_error_message());
	return -1;
}

/* paths[0..n) from the camera to their ends, and into the film. */
static int run_wave(struct wave *w, size_t n, struct trace_stats *stats, char *message, size_t size)
{
	struct pool *pool = w->setup->pool;
	size_t alive = n;
	w->round = 0;
	pool_for(pool, n, start, w);
	for (w->round = 1; alive > 0; w->round++) {
		pool_for(pool, alive, hit, w);
		alive = gather(w->alive, alive, w->chunk_alive);
		if (w->round > (uint32_t)w->setup->bounces)
			break;
		pool_for(pool, alive, prepare, w);
		const size_t lit = gather(w->lit, alive, w->chunk_lit);
		pool_for(pool, lit, prepare_eval, w);
		if (run_batches(w, alive, lit, stats, message, size) != 0)
			return -1;
		pool_for(pool, lit, finish_eval, w);
		pool_for(pool, alive, finish_sample, w);
		alive = gather(w->alive, alive, w->chunk_alive);
	}
	for (size_t i = 0; i < n; i++) {
		double *sum = w->film->sum + (size_t)w->paths[i].pixel * 3;
		sum[0] += (double)w->paths[i].radiance.r;
		sum[1] += (double)w->paths[i].radiance.g;
		sum[2] += (double)w->paths[i].radiance.b;
	}
	stats->samples += n;
	return 0;
}

/* All arrays of a wave of n paths, in one block. */
static int wave_alloc(struct wave *w, size_t n)
{
	enum { ARRAYS = 2 + 2 * (WORDS + FLOATS) };
	const size_t chunks = (n + POOL_CHUNK - 1) / POOL_CHUNK;
	w->paths = malloc(n * sizeof *w->paths);
	w->memory = malloc((ARRAYS * n + 2 * chunks) * sizeof(uint32_t));
	if (!w->paths || !w->memory)
		return -1;
	uint32_t *next = w->memory;
	w->alive = next;
	w->lit = next + n;
	next += 2 * n;
	for (int b = 0; b < 2; b++) {
		struct batch_arrays *arrays = b ? &w->eval : &w->sample;
		for (int k = 0; k < WORDS; k++, next += n)
			arrays->words[k] = next;
		for (int k = 0; k < FLOATS; k++, next += n)
			arrays->floats[k] = (float *)(void *)next;
	}
	w->chunk_alive = next;
	w->chunk_lit = next + chunks;
	return 0;
}

int trace(struct film *film, const struct trace_setup *setup, uint32_t until, struct trace_stats *stats, char *message,
	  size_t size)
{
	const uint64_t pixels = (uint64_t)film->width * (uint64_t)film->height;
	struct wave w;
	memset(&w, 0, sizeof w);
	w.setup = setup;
	w.film = film;
	int status = wave_alloc(&w, WAVE);
	if (status != 0)
		snprintf(message, size, "out of memory");
	const uint64_t end = pixels * until;
	for (w.first = pixels * film->samples; status == 0 && w.first < end;) {
		const uint64_t n = end - w.first < WAVE ? end - w.first : WAVE;
		status = run_wave(&w, (size_t)n, stats, message, size);
		w.first += n;
		if (status == 0 && setup->progress)
			setup->progress(setup->context, stats->samples);
	}
	if (status == 0 && film->samples < until)
		film->samples = until;
	free(w.paths);
	free(w.memory);
	return status;
}
