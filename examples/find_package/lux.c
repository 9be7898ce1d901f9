/* SPDX-License-Identifier: Apache-2.0 */
/* Red of the lightmap's first texel under a mix: lux NAME.sconce [GROUP=SETTING...] */
#include <sconce.h>
#include <stdio.h>

int main(int argc, char** argv) {
  char message[512];
  sconce_package* package = sconce_package_open(argc > 1 ? argv[1] : "", message, sizeof message);
  if (package == NULL) return fprintf(stderr, "%s\n", message), 1;
  float weights[3 * sconce_package_group_count(package)];
  if (sconce_package_weights(package, (const char* const*)argv + 2, (size_t)argc - 2, NULL, weights, message,
                             sizeof message) != 0 ||
      sconce_package_mix(package, weights, message, sizeof message) != 0)
    return fprintf(stderr, "%s\n", message), 1;
  printf("%g lux\n", sconce_package_mixed(package, 0)[0]);
  sconce_package_close(package);
}
