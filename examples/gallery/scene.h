/* scene.h - what is looked at: rows of balls on a table, and the camera. */
#ifndef GALLERY_SCENE_H
#define GALLERY_SCENE_H

#include "lobe/lobe.h"

enum { SCENE_COLUMNS = 6, SCENE_ROWS = 6, SCENE_BALLS = SCENE_COLUMNS * SCENE_ROWS };

enum {
	SCENE_GROUND = SCENE_BALLS, /* as a hit: what is not a ball's number */
	SCENE_NOTHING = -1
};

/* Materials: one per ball, by its number, then the two of the ground. */
enum { SCENE_MATERIALS = SCENE_BALLS + 2 };

struct scene {
	lobe_bsdf material[SCENE_MATERIALS];
	lobe_vec3 eye, forward, right, up; /* right and up reach the frame's edges of a square picture */
};

/* A ray starts on a surface it must not meet again by rounding, so it says where it comes from: on SCENE_GROUND, on the
 * outside of a ball, inside the ball, or SCENE_NOTHING. */
struct ray {
	lobe_vec3 origin, dir;
	int from, inside;
};

struct hit {
	lobe_vec3 position;
	lobe_frame frame;
	uint32_t material;
};

void scene_make(struct scene *scene);

/* Through x, y of the picture, both in [-1,1], x to the right and y up; aspect is width over height. */
struct ray scene_camera_ray(const struct scene *scene, float x, float y, float aspect);

/* The ball the ray meets first, SCENE_GROUND or SCENE_NOTHING; and how far away. */
int scene_intersect(const struct ray *ray, float *distance);

/* What was hit there. */
struct hit scene_hit(const struct ray *ray, int what, float distance);

#endif
