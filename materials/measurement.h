// The measurement record: Psi and Delta of a sample against wavelength and angle of incidence.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drude {

struct MeasurementRow {
    double wavelength_nm = 0;    // vacuum, at least 1: less was meant in micrometres
    double angle_deg = 0;        // of incidence, from the normal, in (0, 90)
    double psi_deg = 0;          // in [0, 90]
    double delta_deg = 0;        // any 360 degree window; kept as read
    double sigma_psi_deg = 0;    // 0 where not known
    double sigma_delta_deg = 0;  // 0 where not known
    double depolarization = -1;  // in [0, 1]; -1 where not known
    int line = 0;                // in the file it came from; 0 where it came from none
};

struct Measurement {
    std::string file;
    std::vector<std::pair<std::string, std::string>> header;  // key, value
    std::vector<MeasurementRow> rows;

    std::string header_value(const std::string& key) const;
    std::vector<double> wavelengths() const;  // distinct, ascending
    std::vector<double> angles() const;       // distinct, ascending
    bool has_sigma() const;                   // every row has both sigmas
    bool has_depolarization() const;          // every row has it

    // Throws Error (user) with file:line for what MeasurementRow's bounds forbid, NaN, and
    // duplicate (wavelength, angle) pairs, and for a measurement without rows.
    void check() const;
};

// The project's CSV: "# key: value" header, then
// wavelength_nm,angle_deg,psi_deg,delta_deg[,sigma_psi_deg,sigma_delta_deg[,depolarization]].
// Reading ends in check().
Measurement parse_measurement(const std::string& text, const std::string& file);
Measurement read_measurement(const std::string& path);
std::string format_measurement(const Measurement& measurement);
void write_measurement(const std::string& path, const Measurement& measurement);

}  // namespace drude
