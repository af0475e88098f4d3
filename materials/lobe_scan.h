// The lobe-scan record: reflectance against the detector's offset from the mirror direction, the
// measurement that holds the roughness of a surface.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drude {

// One position of the detector in the plane of incidence, at angle_deg + offset_deg from the
// normal (the mirror direction is at offset 0; positive is away from the normal).
struct LobeScanRow {
    double wavelength_nm = 0;  // vacuum, > 0
    double angle_deg = 0;      // of incidence, in (0, 90)
    double offset_deg = 0;     // angle_deg + offset_deg in (-90, 90)
    // Detected over straight-through flux for light polarised along s and p, the beam smaller than
    // the detector: BRDF times cos(theta_o) times solid angle. Noise may take it below 0.
    double reflectance_s = 0, reflectance_p = 0;
    double sigma_s = 0, sigma_p = 0;  // standard deviations, > 0
    int line = 0;                     // in the file it came from; 0 where it came from none
};

struct LobeScan {
    std::string file;
    std::vector<std::pair<std::string, std::string>> header;  // key, value
    double detector_solid_angle_sr = 0;                       // in (0, 2 pi)
    double detector_half_angle_deg = 0;                       // of its cone, in (0, 90)
    std::vector<LobeScanRow> rows;

    // Throws Error (user) with file:line for what the bounds above forbid, for NaN, for duplicate
    // rows and for a scan without rows.
    void check() const;
};

// The project's CSV: "# key: value" header with detector_solid_angle_sr and
// detector_half_angle_deg, then
// wavelength_nm,angle_deg,offset_deg,reflectance_s,reflectance_p,sigma_s,sigma_p.
// Reading ends in check().
LobeScan parse_lobe_scan(const std::string& text, const std::string& file);
LobeScan read_lobe_scan(const std::string& path);
std::string format_lobe_scan(const LobeScan& scan);

}  // namespace drude
