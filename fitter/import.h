// Reading what ellipsometers write.
#pragma once

#include <string>
#include <vector>

#include "materials/measurement.h"

namespace drude {

// "auto", then every format by name: "csv" (the project's own, materials/measurement.h),
// "spectraray" (import_spectraray.h).
const std::vector<std::string>& measurement_formats();

// The format of a file by its content: "csv" or "spectraray", or "" where it is none of them.
std::string recognise_measurement(const std::string& text);

// Reads a measurement of Psi and Delta. `format` "auto" goes by content, not by name. Throws Error
// (user) with file and line for what the format forbids, for an unknown format, and for content
// that none of the formats starts with.
Measurement import_measurement(const std::string& path, const std::string& format = "auto");
Measurement parse_measurement_as(const std::string& text, const std::string& file,
                                 const std::string& format);

}  // namespace drude
