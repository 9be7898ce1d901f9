/* SPDX-License-Identifier: Apache-2.0 */
/* Global illumination for a renderer of your own, as a C interface: give the geometry and one function that
 * draws faces into a texture; take an ambient term per vertex, every frame. Follows rays once, when it is
 * created; no OpenGL. A handle may be used by one thread at a time; each call uses all cores.
 * docs/foreign-renderers.md tells what drawing means. */
#ifndef SCONCE_DETECT_H
#define SCONCE_DETECT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sconce_gi sconce_gi;

/* Triangles, counter-clockwise seen from the front. Read while sconce_gi_create() runs. */
typedef struct sconce_geometry {
  const float* positions; /* 3 per vertex, m */
  const float* normals;   /* 3 per vertex, unit; NULL: of the faces */
  size_t vertices;
  const uint32_t* indices;   /* 3 per triangle */
  const uint32_t* materials; /* per triangle; NULL: all have material 0 */
  size_t triangles;
} sconce_geometry;

enum { SCONCE_LIGHTS_NONE, SCONCE_LIGHTS_PROBE, SCONCE_LIGHTS_ALL };
enum { SCONCE_TARGET_LINEAR, SCONCE_TARGET_SRGB8, SCONCE_TARGET_POWER8 };

/* One drawing of faces into a texture; detect/host.h says the same in C++. */
typedef struct sconce_draw_request {
  int lights;                /* none; the probe alone, without shadows; all of the scene, with theirs */
  float probe_to_light[3];   /* unit: the probe's light is parallel */
  float probe_intensity;     /* x what the renderer calls 1 */
  float eye[3];              /* where shaders find the camera; not with all lights */
  int white_card;            /* 1: draw a diffuse material of reflectance 1 instead of the faces' own */
  float background;          /* clear to this grey first, linear */
  int width, height;         /* pixels */
  size_t count;              /* faces to draw */
  const uint32_t* faces;     /* their triangles */
  const float* corners;      /* 6 per face: x, y of its corners, in pixels from the first row's first corner;
                              * counter-clockwise where rows go up, clockwise where the face's back is asked for */
  double* read_milliseconds; /* may be set: what of the function's time reading back took */
} sconce_draw_request;

/* Fills width x height x RGB floats (linear) or bytes (the other targets). Returns 0, or another number where
 * it failed: that is reported, and the ambient term is black. */
typedef int (*sconce_draw)(void* user, const sconce_draw_request* request, void* pixels);

typedef struct sconce_gi_params {
  int target;         /* SCONCE_TARGET_... */
  int by_face;        /* 1: materials by face, 2: by texel, for renderers whose materials are not uniform */
  int samples;        /* of the surfaces, a power of four, 256 to 65536; 0: 16384 */
  int rays;           /* per vertex; 0: 512 */
  float milliseconds; /* of solving per frame, the rest follows while light rests; 0: all at once */
  float texel;        /* m, of direct light; 0: a 256th of the scene's size */
  int movable;        /* 1: sconce_gi_move() may be called; what is needed for it is kept */
  int lobes;          /* 1: materials that are not Lambertian get a lobe fitted */
} sconce_gi_params;

enum { SCONCE_LOBE_NONE, SCONCE_LOBE_PHONG, SCONCE_LOBE_BLINN };

/* Diffuse reflectance x cosine + strength x cos(angle)^exponent, both times what a white card that faces the
 * light shows; detect/lobe.h. */
typedef struct sconce_lobe {
  int kind;
  float diffuse[3], strength[3], exponent;
  float roughness; /* as the width of a microfacet distribution */
  float residual;  /* under lights and eyes that were not fitted to, share of a white card's light */
} sconce_lobe;

typedef struct sconce_material {
  float emission[3], transmission[3], reflectance[3]; /* linear */
  size_t faces;                                       /* that were looked at; 0: nothing is known */
  float residual;   /* under held-out lights, share of a white card's light */
  int lambertian;   /* 0: it is not, and its reflection is wrong by the residual */
  sconce_lobe lobe; /* where lobes were asked for and it is not */
} sconce_material;

typedef struct sconce_frame {
  double capture_milliseconds; /* in the renderer, reading back included */
  double read_milliseconds;    /* of them reading back, as far as the renderer tells */
  double solve_milliseconds;
  int following;  /* 1: things moved, and the light is still that of their old places */
  size_t coarse;  /* vertices whose light is right only in the mean of many, so far */
  size_t clipped; /* points brighter than the target can hold */
} sconce_frame;

/* Detects materials and makes the operator. `draw` is called now and at every update.
 * On failure returns NULL and writes one line to `message` (may be NULL). */
sconce_gi* sconce_gi_create(const sconce_geometry* geometry, sconce_draw draw, void* user,
                            const sconce_gi_params* params, char* message, size_t message_size);
void sconce_gi_destroy(sconce_gi* gi);

size_t sconce_gi_material_count(const sconce_gi* gi);
void sconce_gi_material(const sconce_gi* gi, size_t material, sconce_material* out);
/* After the renderer's materials changed; what light goes through stays as it was. Returns 0, or 1 and writes
 * to `message`: then the old ones stay. */
int sconce_gi_detect(sconce_gi* gi, char* message, size_t message_size);

/* After things moved: all vertices at their new places, in the same order. Only what saw the movement is made
 * again, in the background; a second call waits for the first. Returns 0, or 1 and writes to `message`: then
 * all is as before. */
int sconce_gi_move(sconce_gi* gi, const float* positions, const float* normals, char* message,
                   size_t message_size);

/* Draws the direct light and solves. `ambient`: 3 per vertex, linear, to be multiplied by the surface's
 * reflectance and added to what it shows. `frame` may be NULL. Returns 0, or 1 and writes to `message`: then
 * the ambient term is black. */
int sconce_gi_update(sconce_gi* gi, float* ambient, sconce_frame* frame, char* message, size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
