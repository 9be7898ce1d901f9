// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "photometry/formats.h"

namespace sconce {

Photometry read_photometry(const std::filesystem::path& path) {
  try {
    return read_gldf(path);
  } catch (const NotMyFormat&) {
  }
  return parse_photometry(read_file(path), path.string(),
                          path.parent_path().empty() ? "." : path.parent_path());
}

Photometry parse_photometry(std::string_view text, const std::string& where,
                            const std::filesystem::path& folder) {
  // XML first: its text may hold anything.
  try {
    return parse_tm33(text, where);
  } catch (const NotMyFormat&) {
  }
  try {
    return parse_ies(text, where, folder);
  } catch (const NotMyFormat&) {
  }
  try {
    return parse_ldt(text, where);
  } catch (const NotMyFormat&) {
    // Of a file that says what it is, what is wrong with that.
    if (lower(std::filesystem::path(where).extension().string()) == ".ldt") throw;
    throw NotMyFormat(where, "is no photometric file that can be read", "IES LM-63, EULUMDAT, TM-33, GLDF");
  }
}

}  // namespace sconce
