// SPDX-License-Identifier: Apache-2.0
#include "tone/curve.h"

namespace sconce {

Rgb tone_linear(const Rgb& exposed, const ToneParams&) {
  return curve::to_unit(curve::clean(exposed));
}

}  // namespace sconce
