/* SPDX-License-Identifier: Apache-2.0 */
/* Indirect light in a renderer of your own, in C: lights the points of an operator with a bulb and prints
 * what comes back. Run it with NAME.sconce/operators/lightmap.bin X Y Z CANDELA. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <sconce.h>

/* Illuminance by a bulb at a point, without shadows: here your renderer has its own lights and shadow maps.
 */
static float lit(const sconce_point* p, const float* bulb, float candela) {
  float to[3], distance2 = 0, cosine = 0, above = 0;
  for (int c = 0; c < 3; ++c) {
    to[c] = bulb[c] - p->position[c];
    distance2 += to[c] * to[c];
    cosine += to[c] * p->normal[c];
    above += to[c] * p->facing[c];
  }
  if (cosine <= 0 || above <= 0) return 0;
  return candela * cosine / (distance2 * sqrtf(distance2));
}

int main(int argc, char** argv) {
  char message[512];
  if (argc != 6) {
    fprintf(stderr, "indirect OPERATOR X Y Z CANDELA\n");
    return 2;
  }
  sconce_transfer* transfer = sconce_transfer_open(argv[1], message, sizeof message);
  if (transfer == NULL) {
    fprintf(stderr, "%s\n", message);
    return 1;
  }

  /* Once: the points that want direct light. */
  const size_t n = sconce_transfer_gather_count(transfer), rows = sconce_transfer_receiver_count(transfer);
  sconce_point* points = malloc(n * sizeof *points);
  float *direct = malloc(3 * n * sizeof *direct), *indirect = malloc(3 * rows * sizeof *indirect);
  sconce_transfer_gather_points(transfer, points);

  /* Every frame: light them, and take the indirect light of all receivers. */
  const float bulb[3] = {strtof(argv[2], NULL), strtof(argv[3], NULL), strtof(argv[4], NULL)};
  for (size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) direct[3 * i + c] = lit(&points[i], bulb, strtof(argv[5], NULL));
  const int bad = sconce_transfer_apply(transfer, direct, indirect);

  double sum = 0;
  for (size_t i = 0; i < 3 * rows; ++i) sum += indirect[i];
  printf("%zu points, %zu receivers, %g lux of indirect light on the mean\n", n, rows,
         sum / (3.0 * (double)rows));
  sconce_transfer_close(transfer);
  free(points), free(direct), free(indirect);
  return bad;
}
