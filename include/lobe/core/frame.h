/* frame.h - orthonormal shading frames, and directions in and out of them. */
#ifndef LOBE_CORE_FRAME_H
#define LOBE_CORE_FRAME_H

#include "vec.h"

/* tangent, bitangent, normal: unit, orthogonal, right-handed (tangent x bitangent = normal). */
typedef struct {
	lobe_vec3 t, b, n;
} lobe_frame;

/* A frame around the unit vector n, with no singular direction: Duff et al. 2017, "Building an orthonormal basis,
 * revisited", JCGT 6(1). The tangent jumps where n.z changes sign, as it must somewhere. */
LOBE_FN lobe_frame lobe_frame_from_normal(lobe_vec3 n)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real s = n.z < LOBE_R(0.0) ? -one : one;
	const lobe_real a = -one / (s + n.z);
	const lobe_real b = n.x * n.y * a;
	lobe_frame f;
	f.t = lobe_vec3_make(lobe_fma(s * n.x * n.x, a, one), s * b, -s * n.x);
	f.b = lobe_vec3_make(b, lobe_fma(n.y * n.y, a, s), -n.y);
	f.n = n;
	return f;
}

/* The frame around the unit vector n whose tangent is nearest to t (|t| between 1e-9 and 1e9, not parallel to n): for
 * anisotropic lobes, with t along the brushing. */
LOBE_FN lobe_frame lobe_frame_from_normal_tangent(lobe_vec3 n, lobe_vec3 t)
{
	lobe_frame f;
	f.n = n;
	f.b = lobe_normalize(lobe_cross(n, t));
	f.t = lobe_cross(f.b, n);
	return f;
}

/* v, given in world space, in the frame. */
LOBE_FN lobe_vec3 lobe_frame_to_local(lobe_frame f, lobe_vec3 v)
{
	return lobe_vec3_make(lobe_dot(v, f.t), lobe_dot(v, f.b), lobe_dot(v, f.n));
}

/* v, given in the frame, in world space. */
LOBE_FN lobe_vec3 lobe_frame_to_world(lobe_frame f, lobe_vec3 v)
{
	return lobe_vec3_fma(v.x, f.t, lobe_vec3_fma(v.y, f.b, lobe_vec3_scale(f.n, v.z)));
}

#endif
