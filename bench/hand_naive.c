/* hand_naive.c - a rough conductor as engines have it: scalar C with early returns and libm, GGX with visible normals
 * (Heitz 2018, "Sampling the GGX Distribution of Visible Normals", the listing in its appendix, by its steps), exact
 * conductor Fresnel by channel. Shares nothing with lobe's headers but the parameters' struct. */
#include <math.h>

#include "hand.h"

typedef struct {
	float x, y, z;
} vec;

static float dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static vec scaled(vec a, float s)
{
	const vec v = {a.x * s, a.y * s, a.z * s};
	return v;
}

static vec normalized(vec a) { return scaled(a, 1.0f / sqrtf(dot(a, a))); }

static float distribution(vec h, float ax, float ay)
{
	const float sx = h.x / ax, sy = h.y / ay;
	const float t = sx * sx + sy * sy + h.z * h.z;
	return 1.0f / (3.14159265f * ax * ay * t * t);
}

static float lambda(vec w, float ax, float ay)
{
	const float sx = ax * w.x, sy = ay * w.y;
	return 0.5f * (sqrtf(1.0f + (sx * sx + sy * sy) / (w.z * w.z)) - 1.0f);
}

static float fresnel(float c, float eta, float k)
{
	const float c2 = c * c, s2 = 1.0f - c2;
	const float t0 = eta * eta - k * k - s2;
	const float a2b2 = sqrtf(t0 * t0 + 4.0f * eta * eta * k * k);
	const float t1 = a2b2 + c2;
	const float a = sqrtf(fmaxf(0.0f, 0.5f * (a2b2 + t0)));
	const float t2 = 2.0f * c * a;
	const float rs = (t1 - t2) / (t1 + t2);
	const float t3 = c2 * a2b2 + s2 * s2, t4 = t2 * s2;
	return 0.5f * (rs + rs * (t3 - t4) / (t3 + t4));
}

static float density(vec wo, vec h, float ax, float ay)
{
	return distribution(h, ax, ay) / (4.0f * wo.z * (1.0f + lambda(wo, ax, ay)));
}

void bench_naive_eval(const lobe_ggx_conductor *p, const lobe_batch *b)
{
	const float ax = p->stretch.alpha_x, ay = p->stretch.alpha_y;
	for (size_t i = 0; i < b->count; i++) {
		const vec wo = {b->wo[0][i], b->wo[1][i], b->wo[2][i]}, wi = {b->wi[0][i], b->wi[1][i], b->wi[2][i]};
		if (wo.z <= 0.0f || wi.z <= 0.0f) {
			b->f[0][i] = b->f[1][i] = b->f[2][i] = b->pdf[i] = 0.0f;
			continue;
		}
		const vec sum = {wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
		const vec h = normalized(sum);
		const float c = dot(wo, h);
		const float f =
			distribution(h, ax, ay) / (4.0f * wo.z * (1.0f + lambda(wo, ax, ay) + lambda(wi, ax, ay)));
		b->f[0][i] = f * fresnel(c, p->eta.r, p->k.r);
		b->f[1][i] = f * fresnel(c, p->eta.g, p->k.g);
		b->f[2][i] = f * fresnel(c, p->eta.b, p->k.b);
		b->pdf[i] = density(wo, h, ax, ay);
	}
}

void bench_naive_sample(const lobe_ggx_conductor *p, const lobe_batch *b)
{
	const float ax = p->stretch.alpha_x, ay = p->stretch.alpha_y;
	for (size_t i = 0; i < b->count; i++) {
		const vec wo = {b->wo[0][i], b->wo[1][i], b->wo[2][i]};
		b->sample_wi[0][i] = b->sample_wi[1][i] = b->sample_wi[2][i] = 0.0f;
		b->weight[0][i] = b->weight[1][i] = b->weight[2][i] = b->sample_pdf[i] = 0.0f;
		b->event[i] = 0;
		if (wo.z <= 0.0f)
			continue;
		const vec stretched = {ax * wo.x, ay * wo.y, wo.z};
		const vec v = normalized(stretched);
		const float length = v.x * v.x + v.y * v.y;
		vec t1 = {1.0f, 0.0f, 0.0f};
		if (length > 0.0f) {
			const float inv = 1.0f / sqrtf(length);
			t1.x = -v.y * inv;
			t1.y = v.x * inv;
		}
		const vec t2 = {v.y * t1.z - v.z * t1.y, v.z * t1.x - v.x * t1.z, v.x * t1.y - v.y * t1.x};
		const float r = sqrtf(b->u[0][i]), phi = 6.28318531f * b->u[1][i];
		const float x = r * cosf(phi), s = 0.5f * (1.0f + v.z);
		const float y = (1.0f - s) * sqrtf(1.0f - x * x) + s * r * sinf(phi);
		const float z = sqrtf(fmaxf(0.0f, 1.0f - x * x - y * y));
		const vec n = {ax * (x * t1.x + y * t2.x + z * v.x), ay * (x * t1.y + y * t2.y + z * v.y),
			       fmaxf(0.0f, x * t1.z + y * t2.z + z * v.z)};
		const vec h = normalized(n);
		const float c = dot(wo, h);
		const vec wi = {2.0f * c * h.x - wo.x, 2.0f * c * h.y - wo.y, 2.0f * c * h.z - wo.z};
		if (wi.z <= 0.0f)
			continue;
		const float lo = lambda(wo, ax, ay), li = lambda(wi, ax, ay);
		const float weight = (1.0f + lo) / (1.0f + lo + li);
		b->sample_wi[0][i] = wi.x;
		b->sample_wi[1][i] = wi.y;
		b->sample_wi[2][i] = wi.z;
		b->weight[0][i] = weight * fresnel(c, p->eta.r, p->k.r);
		b->weight[1][i] = weight * fresnel(c, p->eta.g, p->k.g);
		b->weight[2][i] = weight * fresnel(c, p->eta.b, p->k.b);
		b->sample_pdf[i] = density(wo, h, ax, ay);
		b->event[i] = LOBE_EVENT_REFLECT | LOBE_EVENT_GLOSSY;
	}
}
