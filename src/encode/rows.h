// SPDX-License-Identifier: Apache-2.0
// The rows of table.cpp, each defined in its own file.
#pragma once

#include "encode/encoding.h"

namespace sconce {

extern const Encoding kEncodingF32;
extern const Encoding kEncodingF16;
extern const Encoding kEncodingExp8;
extern const Encoding kEncodingRgbe8;
extern const Encoding kEncodingSrgbe8;
extern const Encoding kEncodingMulti8;
extern const Encoding kEncodingBc6h;

}  // namespace sconce
