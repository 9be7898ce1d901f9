// SPDX-License-Identifier: Apache-2.0
// The rows of table.cpp, each defined in its own file.
#pragma once

#include "encode/encoding.h"

namespace sconce {

extern const Encoding kEncodingF32;
extern const Encoding kEncodingF16;

}  // namespace sconce
