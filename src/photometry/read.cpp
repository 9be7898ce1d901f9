// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "core/files.h"
#include "photometry/formats.h"

namespace sconce {

Photometry read_photometry(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  // XML first: its text may hold anything.
  try {
    return parse_tm33(text, path.string());
  } catch (const NotMyFormat&) {
  }
  try {
    return parse_ies(text, path.string(), path.parent_path().empty() ? "." : path.parent_path());
  } catch (const NotMyFormat&) {
  }
  try {
    return parse_ldt(text, path.string());
  } catch (const NotMyFormat&) {
    throw NotMyFormat(path.string(), "is no photometric file that can be read", "IES LM-63, EULUMDAT, TM-33");
  }
}

}  // namespace sconce
