// SPDX-License-Identifier: Apache-2.0
// Photometric files. One file per format and direction; what is read can be written back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "photometry/photometry.h"

namespace sconce {

/// IES LM-63 (1986, 91, 95, 2002, 2019), EULUMDAT, TM-33 or GLDF, by content. TILT=<file> is looked for
/// beside the file.
/// @throws Error naming file:line and what was expected; NotMyFormat where the file is neither
Photometry read_photometry(const std::filesystem::path& path);

/// The same from a text. @param where  for errors @param folder  where a TILT=<file> lies
Photometry parse_photometry(std::string_view text, const std::string& where,
                            const std::filesystem::path& folder = {});

/// IES LM-63. Types A, B and C, every symmetry, -1 lumens, TILT.
/// @param where   for errors: the file
/// @param folder  where a TILT=<file> lies
/// @throws NotMyFormat (no TILT= line), Error
Photometry parse_ies(std::string_view text, const std::string& where,
                     const std::filesystem::path& folder = {});

/// EULUMDAT. Intensities are per 1000 lm of the first lamp set.
/// @throws NotMyFormat (the first numbers are not those of an LDT), Error
Photometry parse_ldt(std::string_view text, const std::string& where);

/// IES TM-33 (2018, 2022) and ATLA S001, XML: the luminous intensities of its one emitter, type C. Spectra
/// and the housing's sizes become notes, as neither says where or how the lamp shines from near.
/// @throws NotMyFormat (no such XML), Error
Photometry parse_tm33(std::string_view text, const std::string& where);

/// GLDF, a zip with product.xml: the photometric file (EULUMDAT, LM-63, TM-33) that its first variant's
/// emitter refers to; other variants are a note. @throws NotMyFormat (no zip), Error: several emitters with
/// different files, files that are missing or lie on the net
Photometry read_gldf(const std::filesystem::path& path);

/// LM-63-2002 text. Numbers are written so that they read back as the same doubles.
std::string write_ies(const Photometry& photometry);

/// EULUMDAT text; types A and B are made type C tables of 2.5 degrees first. Numbers are exact but for the
/// division by the lamp flux. @throws Error when nothing shines (there is then no flux to relate to)
std::string write_ldt(const Photometry& photometry);

}  // namespace sconce
