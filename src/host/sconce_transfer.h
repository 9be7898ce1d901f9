/* SPDX-License-Identifier: Apache-2.0 */
/* The bare direct-to-indirect operator for any renderer, as a C interface: here are N points, give their
 * direct light, take the indirect light of all receivers. Files come from `sconce transfer`. No rays, no
 * OpenGL. A handle may be used by one thread at a time; each call uses all cores. */
#ifndef SCONCE_TRANSFER_H
#define SCONCE_TRANSFER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sconce_transfer sconce_transfer;

/* A point of a surface; colours are linear Rec. 709. */
typedef struct sconce_point {
  float position[3]; /* m, as in the package's scene.glb */
  float normal[3];   /* interpolated, unit: light is weighted with its cosine */
  float facing[3];   /* of the face, unit: light from below its horizon does not count */
  float albedo[3];   /* diffuse reflectance */
} sconce_point;

/* Maps the file and checks it. On failure returns NULL and writes one line to `message` (may be NULL). */
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
