// Reading what ellipsometers write.
#pragma once

#include <string>
#include <vector>

#include "materials/measurement.h"

namespace drude {

// "auto", then every format by name. Each is described at the top of its header:
// "csv" (the project's own, materials/measurement.h), "spectraray", "completeease" and "wvase" (one
// reader: import_woollam.h), "accurion", "horiba", "filmsense", "table" (import_table.h).
const std::vector<std::string>& measurement_formats();

// The format of a file by its content, never "auto", or "" where it is none of them.
std::string recognise_measurement(const std::string& text);

// Reads a measurement of Psi and Delta. `format` "auto" goes by content, not by name. Throws Error
// (user) with file and line for what the format forbids, for an unknown format, and for content
// that none of the formats starts with. What a reader left out or changed stands in the header
// under "warning".
Measurement import_measurement(const std::string& path, const std::string& format = "auto");
Measurement parse_measurement_as(const std::string& text, const std::string& file,
                                 const std::string& format);

// The values of the header's "warning" keys.
std::vector<std::string> import_warnings(const Measurement& measurement);

}  // namespace drude
