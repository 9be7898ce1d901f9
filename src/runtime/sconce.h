/* SPDX-License-Identifier: Apache-2.0 */
/* sconce-runtime: what an engine needs of sconce, as a C interface. Read a package, mix its light groups on
 * the CPU or by a composed shader, and send light through a transfer operator. No rays, no OpenGL, no
 * importers.
 *
 * Conventions. Layers and mixes are illuminance E in lux, linear Rec. 709, all bounces, without the albedo of
 * the surface they lie on. A diffuse surface shows the luminance albedo * E / pi (cd/m2), and its own
 * emission. They are looked up by TEXCOORD_n of the package's scene.glb, n = sconce_atlas.uv_set, on the page
 * of the mesh node: row 0 is v = 0, texel (x, y) lies at u = (x + 0.5) / width, v = (y + 0.5) / height;
 * bilinearly, clamped at the edges of the page, without mipmaps. Weights are linear RGB, three floats per
 * group.
 *
 * What can fail takes a buffer for one line that says why (`message` may be NULL). Texts and arrays that are
 * returned belong to their handle. A handle may be used by one thread at a time; calls use all cores. */
#ifndef SCONCE_H
#define SCONCE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the library that is linked, e.g. "0.1.0". */
const char* sconce_version(void);

/* ---- The package NAME.sconce. Groups and their order are those of `sconce info`. ---- */

typedef struct sconce_package sconce_package;

typedef struct sconce_atlas {
  int width, height, pages; /* of the lightmap, in texels */
  int uv_set;               /* n of the TEXCOORD_n of scene.glb */
  size_t nodes;             /* mesh nodes of scene.glb */
} sconce_atlas;

typedef struct sconce_group {
  const char* name;
  double lumens;   /* at weight 1; 0 for sky and sun */
  double mean_lux; /* of its layer, area-weighted */
  float color[3];  /* of its lamps, luminance 1 */
  int infinite;    /* sky or sun */
} sconce_group;

/* Reads and checks the package; layers are read when they are asked for. NULL on failure. */
sconce_package* sconce_package_open(const char* path, char* message, size_t message_size);
void sconce_package_close(sconce_package* package);

sconce_atlas sconce_package_atlas(const sconce_package* package);
/* Page of a mesh node of scene.glb, in node order; -1: it has no lightmap, or there is no such node. */
int sconce_package_page(const sconce_package* package, size_t node);
size_t sconce_package_group_count(const sconce_package* package);
/* 0; or 1 where there is no such group: nothing is written. */
int sconce_package_group(const sconce_package* package, size_t index, sconce_group* group);

/* `settings` are "GROUP=SETTING" as `sconce render` takes them, e.g. "ceiling=50%,2700K"; later ones win.
 * `others`: the setting of groups that are not named, NULL: 1. Writes 3 floats per group. 0, or 1. */
int sconce_package_weights(const sconce_package* package, const char* const* settings, size_t count,
                           const char* others, float* weights, char* message, size_t message_size);

/* Sums the layers. The first call reads them; later ones read those whose weights changed, where that is
 * less. 0, or 1. */
int sconce_package_mix(sconce_package* package, const float* weights, char* message, size_t message_size);
/* A page of the last mix, height * width * RGB, lux; until the next mix. NULL before, or if there is none. */
const float* sconce_package_mixed(const sconce_package* package, int page);

/* ---- Probes: the same light for what moves (`sconce bake --probes 1`). ---- */

typedef struct sconce_probes {
  float origin[3]; /* of the first probe, m */
  float spacing;   /* m, along the axes of scene.glb */
  int size[3];     /* probes along x, y, z */
} sconce_probes;

/* Reads them, once. 0; or 1: the package has none, or a damaged file. */
int sconce_package_probes(sconce_package* package, sconce_probes* probes, char* message, size_t message_size);
/* Light at a point, mixed, for a shader: e.rgb, then g.rgb of x, of y and of z, lux. What faces the unit n
 * there receives E = max(0, e + n.x g_x + n.y g_y + n.z g_z) and shows albedo * E / pi. Trilinear between the
 * probes around; points outside count as at the border. 0, or 1. */
int sconce_probe_light(sconce_package* package, const float* weights, const float position[3],
                       float light[12], char* message, size_t message_size);
/* That E, lux RGB. @param normal  unit */
int sconce_probe_irradiance(sconce_package* package, const float* weights, const float position[3],
                            const float normal[3], float rgb[3], char* message, size_t message_size);

/* ---- Shaders that mix, and the textures they want. ---- */

typedef struct sconce_shader sconce_shader;

/* Names are those of `sconce shader`. All zero: a fragment shader for OpenGL 4.5. */
typedef struct sconce_shader_params {
  const char* form;   /* picture, functions, atlas, compute; NULL: picture */
  const char* target; /* glsl450, glsl330, glsl300es; NULL: glsl450 */
  const char* tier;   /* full, half, unfiltered, byte; NULL: full */
  const char* tone;   /* of a picture; "none": linear cd/m2; NULL: agx */
  int units;          /* texture units, 8 or more; 0: 16 */
  int normal_maps;    /* 1: light changes with the normal, where the package tells how */
} sconce_shader_params;

enum { SCONCE_TEXELS_F32, SCONCE_TEXELS_F16, SCONCE_TEXELS_U8, SCONCE_TEXELS_BC6H };

/* A texture that a sampler of the shader wants: clamped to the edge, one level. */
typedef struct sconce_texture {
  const char* sampler;
  int texels;   /* SCONCE_TEXELS_... */
  int channels; /* 1 to 4 */
  int linear;   /* 1: interpolated by the texture unit; 0: nearest */
  int array;    /* 1: one array of `images` slices; 0: a plain texture, `images` pages, that of the drawn page
                   is bound */
  int images;
} sconce_texture;

/* Uniforms beside the samplers: docs/shaders.md. NULL on failure. The package may be closed before. */
sconce_shader* sconce_shader_compose(const sconce_package* package, const sconce_shader_params* params,
                                     char* message, size_t message_size);
void sconce_shader_free(sconce_shader* shader);
const char* sconce_shader_text(const sconce_shader* shader);
size_t sconce_shader_texture_count(const sconce_shader* shader);
/* 0; or 1 where there is no such texture: nothing is written. */
int sconce_shader_texture(const sconce_shader* shader, size_t index, sconce_texture* texture);
/* What to upload, rows without padding, row 0 first; until the next call. NULL if there is none.
 * @param bytes  gets their number; may be NULL */
const void* sconce_shader_texels(sconce_shader* shader, size_t index, int image, size_t* bytes);
/* Weights to the uniform vec3 sconce_weight[groups]: groups whose luminance is packed bring their colour. */
void sconce_shader_weights(const sconce_shader* shader, const float* weights, float* uniform);

/* ---- The bare direct-to-indirect operator: here are N points, give their direct light, take the indirect
 * light of all receivers. Files come from `sconce transfer`. ---- */

typedef struct sconce_transfer sconce_transfer;

/* A point of a surface; colours are linear Rec. 709. */
typedef struct sconce_point {
  float position[3]; /* m, as in the package's scene.glb */
  float normal[3];   /* interpolated, unit: light is weighted with its cosine */
  float facing[3];   /* of the face, unit: light from below its horizon does not count */
  float albedo[3];   /* diffuse reflectance */
} sconce_point;

/* Reads the file and checks it. NULL on failure. */
sconce_transfer* sconce_transfer_open(const char* path, char* message, size_t message_size);
void sconce_transfer_close(sconce_transfer* transfer);

/* How many points want direct light, and how many receive indirect light. */
size_t sconce_transfer_gather_count(const sconce_transfer* transfer);
size_t sconce_transfer_receiver_count(const sconce_transfer* transfer);
/* Fills `points`, as many as there are. */
void sconce_transfer_gather_points(const sconce_transfer* transfer, sconce_point* points);
void sconce_transfer_receivers(const sconce_transfer* transfer, sconce_point* points);
/* Per receiver: the texel or pixel that it is, page * height * width + y * width + x. */
void sconce_transfer_places(const sconce_transfer* transfer, uint32_t* places);

/* Direct light in: lux, RGB per gather point, without albedo. Indirect light out: lux, RGB per receiver, all
 * bounces, without the receiver's albedo. 0; or 1 where a value of `direct` is not finite: it counts as
 * black. */
int sconce_transfer_apply(sconce_transfer* transfer, const float* direct, float* indirect);

#ifdef __cplusplus
}
#endif

#endif
