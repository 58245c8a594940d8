/* linear.h - a microsurface under any linear map that keeps vertical lines vertical: stretch, rotation and skew of the
 * plane, and a shear that tilts the mean plane. Slopes s of the surface of width 1 become A s + mean, where a facet of
 * slopes (x, y) has the normal (-x, -y, 1)/length.
 *
 * The Jacobian is all one needs (Atanasov et al. 2022, "Efficient microfacet transformations"; Heitz 2014, section 5.3
 * and appendix; Dupuy et al. 2013, "Linear efficient antialiased displacement and reflectance mapping", for the shear).
 * The functions are those of stretch.h: directions and normals of the mapped surface turn into those of the surface of
 * width 1, nothing is normalised, and projected areas come out as they are: sigma(w) =
 * sigma_1(lobe_linear_direction(w)), of which the mean plane's share is v.z = w.z - mean.w. That share is what can be
 * seen of the surface from w: where it is not above 0 the mean plane faces away, and yet sigma(w) > 0: some facets face
 * w. smith.h puts it all together.
 *
 * All is per unit of area of the horizontal plane, which no shear changes: the integral of D(m) m.z is 1, and that of
 * D(m) m is the vector (-mean_x, -mean_y, 1), the mean plane's normal times its area.
 *
 * stretch.h is the special case A = diag(alpha_x, alpha_y), mean = 0 that production lobes are built from, with a third
 * of the arithmetic; lobe_linear_stretch gives the same bits (tests/test_linear.c).
 *
 * Domain: widths 1e-4 to 100, mean slopes to 100, correlations to +-0.9999. What single precision costs there is one
 * rounding of each coordinate, magnified by how oblong the map is: D is off by at most 5e-7 times the condition of A,
 * and for Beckmann times 1 + r^2 too, r in widths (tests/test_smith_leadr.c, which looks at r < 8). No form does better,
 * since the rounding of the normal itself does as much. */
#ifndef LOBE_MICROFACET_LINEAR_H
#define LOBE_MICROFACET_LINEAR_H

#include "../core/real.h"
#include "stretch.h"

/* Strongest correlation of slopes: lobe_linear_correlated clamps rho to +-LOBE_RHO_MAX. */
#define LOBE_RHO_MAX LOBE_R(0.9999)

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

/* A width from below: no upper limit, for the facets of a height field may be as steep as they like. A NaN stays
 * one. */
LOBE_FN lobe_real lobe_linear_width(lobe_real alpha) { return alpha < LOBE_ALPHA_MIN ? LOBE_ALPHA_MIN : alpha; }

/* A = R diag(alpha_1, alpha_2), where R turns the x axis into the unit vector (c, s). With the inverse written down,
 * not computed, its small entries keep all their digits. */
LOBE_FN lobe_linear lobe_linear_principal(lobe_real c, lobe_real s, lobe_real alpha_1, lobe_real alpha_2)
{
	const lobe_real i1 = LOBE_R(1.0) / alpha_1;
	const lobe_real i2 = LOBE_R(1.0) / alpha_2;
	lobe_linear m;
	m.xx = c * alpha_1;
	m.xy = -s * alpha_2;
	m.yx = s * alpha_1;
	m.yy = c * alpha_2;
	m.mean_x = LOBE_R(0.0);
	m.mean_y = LOBE_R(0.0);
	m.ixx = c * i1;
	m.ixy = s * i1;
	m.iyx = -s * i2;
	m.iyy = c * i2;
	m.norm = LOBE_INV_PI * i1 * i2;
	return m;
}

/* The surface of stretch.h. Widths below LOBE_ALPHA_MIN are raised to it; those above 1, which stretch.h clamps,
 * stay. */
LOBE_FN lobe_linear lobe_linear_stretch(lobe_real alpha_x, lobe_real alpha_y)
{
	return lobe_linear_principal(LOBE_R(1.0), LOBE_R(0.0), lobe_linear_width(alpha_x), lobe_linear_width(alpha_y));
}

/* The same, turned by angle [radians] about the normal from the tangent towards the bitangent. */
LOBE_FN lobe_linear lobe_linear_rotated(lobe_real alpha_x, lobe_real alpha_y, lobe_real angle)
{
	return lobe_linear_principal(lobe_cos(angle), lobe_sin(angle), lobe_linear_width(alpha_x),
				     lobe_linear_width(alpha_y));
}

/* Slopes of widths alpha_x and alpha_y and correlation rho, clamped to +-LOBE_RHO_MAX: the Cholesky factor
 * (alpha_x 0; rho alpha_y, alpha_y sqrt(1 - rho^2)) that Dupuy et al. 2013 use. */
LOBE_FN lobe_linear lobe_linear_correlated(lobe_real alpha_x, lobe_real alpha_y, lobe_real rho)
{
	const lobe_real one = LOBE_R(1.0);
	const lobe_real r = lobe_clamp(rho, -LOBE_RHO_MAX, LOBE_RHO_MAX);
	const lobe_real root = lobe_sqrt((one - r) * (one + r));
	const lobe_real ix = one / lobe_linear_width(alpha_x);
	const lobe_real iy = one / (lobe_linear_width(alpha_y) * root);
	lobe_linear m;
	m.xx = lobe_linear_width(alpha_x);
	m.xy = LOBE_R(0.0);
	m.yx = r * lobe_linear_width(alpha_y);
	m.yy = root * lobe_linear_width(alpha_y);
	m.mean_x = LOBE_R(0.0);
	m.mean_y = LOBE_R(0.0);
	m.ixx = ix;
	m.ixy = LOBE_R(0.0);
	m.iyx = -r * ix / root;
	m.iyy = iy;
	m.norm = LOBE_INV_PI * ix * iy;
	return m;
}

/* m with its mean plane tilted by further slopes: a shear. */
LOBE_FN lobe_linear lobe_linear_tilted(lobe_linear m, lobe_real mean_x, lobe_real mean_y)
{
	m.mean_x += mean_x;
	m.mean_y += mean_y;
	return m;
}

/* From the mean and the covariance of slopes: A A^T = 2 (var_x cov; cov var_y), so that a Beckmann surface has these
 * very moments (alpha^2 = 2 Var). A GGX surface has no variance - it grows with the logarithm of the steepest slope -
 * and is given the same A by convention: that suits measured moments only as far as their tails have been cut.
 *
 * By principal axes, the small one from the determinant, so that nothing cancels at a correlation of 0.9999. Along an
 * axis of less variance than LOBE_ALPHA_MIN^2/2, or of a negative one (|cov| too large by rounding), the width is
 * LOBE_ALPHA_MIN: what is clamped does not depend on how the axes lie. NaN moments give a NaN map. */
LOBE_FN lobe_linear lobe_linear_from_moments(lobe_real mean_x, lobe_real mean_y, lobe_real var_x, lobe_real var_y,
					     lobe_real cov)
{
	const lobe_real zero = LOBE_R(0.0);
	const lobe_real least = LOBE_ALPHA_MIN * LOBE_ALPHA_MIN;
	const lobe_real d = LOBE_R(0.5) * (var_x - var_y);
	const lobe_real h = lobe_sqrt(lobe_fma(d, d, cov * cov));
	const lobe_real large = lobe_fma(LOBE_R(0.5), var_x + var_y, h);
	const lobe_real lesser = lobe_diff_of_products(var_x, var_y, cov, cov) / (large == zero ? LOBE_R(1.0) : large);
	const lobe_real two_large = large + large;
	const lobe_real two_lesser = lesser + lesser;
	/* The axis of the large one, from whichever of its two forms does not cancel. */
	const lobe_real c = d < zero ? cov : h + d;
	const lobe_real s = d < zero ? h - d : cov;
	const lobe_real len = lobe_sqrt(lobe_fma(c, c, s * s));
	const int round = len == zero;
	const lobe_linear m = lobe_linear_principal(round ? LOBE_R(1.0) : c / len, round ? zero : s / len,
						    lobe_sqrt(two_large < least ? least : two_large),
						    lobe_sqrt(two_lesser < least ? least : two_lesser));
	return lobe_linear_tilted(m, mean_x, mean_y);
}

/* From the map of the surface's points, p -> M p with M = (xx xy 0; yx yy 0; zx zy zz): the M of Atanasov et al. 2022
 * and a shear. D_M(h) = |det M| zz D(M^T h/|M^T h|)/|M^T h|^4 and w turns into M^-1 w (their eqs. have zz = 1). The
 * other two entries are 0, or the image of a height field would not be one. zz > 0. */
LOBE_FN lobe_linear lobe_linear_from_points(lobe_real xx, lobe_real xy, lobe_real yx, lobe_real yy, lobe_real zx,
					    lobe_real zy, lobe_real zz)
{
	const lobe_real det = lobe_diff_of_products(xx, yy, xy, yx);
	const lobe_real scale = zz / det;
	lobe_linear m;
	m.xx = scale * yy;
	m.xy = -scale * yx;
	m.yx = -scale * xy;
	m.yy = scale * xx;
	m.mean_x = lobe_diff_of_products(yy, zx, yx, zy) / det;
	m.mean_y = lobe_diff_of_products(xx, zy, xy, zx) / det;
	m.ixx = xx / zz;
	m.ixy = yx / zz;
	m.iyx = xy / zz;
	m.iyy = yy / zz;
	m.norm = LOBE_INV_PI * lobe_abs(det) / (zz * zz);
	return m;
}

/* First inner, then outer: slopes A_o (A_i s + mean_i) + mean_o. */
LOBE_FN lobe_linear lobe_linear_compose(lobe_linear outer, lobe_linear inner)
{
	return lobe_linear_make(lobe_diff_of_products(outer.xx, inner.xx, -outer.xy, inner.yx),
				lobe_diff_of_products(outer.xx, inner.xy, -outer.xy, inner.yy),
				lobe_diff_of_products(outer.yx, inner.xx, -outer.yy, inner.yx),
				lobe_diff_of_products(outer.yx, inner.xy, -outer.yy, inner.yy),
				lobe_fma(outer.xx, inner.mean_x, lobe_fma(outer.xy, inner.mean_y, outer.mean_x)),
				lobe_fma(outer.yx, inner.mean_x, lobe_fma(outer.yy, inner.mean_y, outer.mean_y)));
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
