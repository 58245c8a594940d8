/* linear.h - a microsurface under any linear map that keeps vertical lines vertical: stretch, rotation and skew of the
 * plane, and a shear that tilts the mean plane. Slopes s of the surface of width 1 become A s + mean.
 *
 * The Jacobian is all one needs (Atanasov et al. 2022, "Efficient microfacet transformations"; Heitz 2014, section 5.3 and
 * appendix; Dupuy et al. 2013, "Linear efficient antialiased displacement and reflectance mapping", for the shear). The
 * functions are those of stretch.h: directions and normals of the mapped surface turn into those of the surface of width 1,
 * nothing is normalised, and projected areas come out as they are: sigma(w) = sigma_1(lobe_linear_direction(w)), of which
 * the mean plane's share is v.z = w.z - mean.w. */
#ifndef LOBE_MICROFACET_LINEAR_H
#define LOBE_MICROFACET_LINEAR_H

#include "../core/constants.h"
#include "../core/vec.h"

/* A = (xx xy; yx yy), det: |A's determinant|. norm: 1/(pi det). ixx..iyy: its inverse. */
typedef struct {
	lobe_real xx, xy, yx, yy;
	lobe_real mean_x, mean_y;
	lobe_real ixx, ixy, iyx, iyy;
	lobe_real norm;
} lobe_linear;

/* Any invertible A. A singular or NaN one gives a map whose norm is no finite number, and lobes that shade to 0. */
LOBE_FN lobe_linear lobe_linear_make(lobe_real xx, lobe_real xy, lobe_real yx, lobe_real yy, lobe_real mean_x,
				     lobe_real mean_y)
{
	const lobe_real det = lobe_diff_of_products(xx, yy, xy, yx);
	lobe_linear m;
	m.xx = xx;
	m.xy = xy;
	m.yx = yx;
	m.yy = yy;
	m.mean_x = mean_x;
	m.mean_y = mean_y;
	m.ixx = yy / det;
	m.ixy = -xy / det;
	m.iyx = -yx / det;
	m.iyy = xx / det;
	m.norm = LOBE_INV_PI / lobe_abs(det);
	return m;
}

/* The direction in which the surface of width 1 is seen, when the mapped one is seen from w. */
LOBE_FN lobe_vec3 lobe_linear_direction(lobe_linear m, lobe_vec3 w)
{
	return lobe_vec3_make(lobe_fma(m.xx, w.x, m.yx * w.y), lobe_fma(m.xy, w.x, m.yy * w.y),
			      lobe_fma(-m.mean_x, w.x, lobe_fma(-m.mean_y, w.y, w.z)));
}

/* The normal on the surface of width 1 that the map turns into h. */
LOBE_FN lobe_vec3 lobe_linear_facet(lobe_linear m, lobe_vec3 h)
{
	const lobe_real x = lobe_fma(m.mean_x, h.z, h.x);
	const lobe_real y = lobe_fma(m.mean_y, h.z, h.y);
	return lobe_vec3_make(lobe_fma(m.ixx, x, m.ixy * y), lobe_fma(m.iyx, x, m.iyy * y), h.z);
}

/* The normal that n, one of the surface of width 1, turns into. */
LOBE_FN lobe_vec3 lobe_linear_normal(lobe_linear m, lobe_vec3 n)
{
	return lobe_vec3_make(lobe_fma(m.xx, n.x, lobe_fma(m.xy, n.y, -m.mean_x * n.z)),
			      lobe_fma(m.yx, n.x, lobe_fma(m.yy, n.y, -m.mean_y * n.z)), n.z);
}

#endif
