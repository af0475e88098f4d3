#include "device/virtual/ellipsometer_simulation.h"

#include <cmath>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/numbers.h"
#include "materials/measurement_noise.h"
#include "materials/surface.h"

namespace drude {

namespace {

void check(const SimulationSetup& setup) {
    if (setup.angles_deg.empty()) user_error("simulate: found no angle of incidence");
    if (setup.wavelengths_nm.empty()) user_error("simulate: found no wavelength");
    for (const double angle : setup.angles_deg) {
        if (!(angle > 0 && angle < 90)) {
            user_error(
                "simulate: found an angle of incidence of {} degrees, expected one above 0 "
                "and below 90",
                angle);
        }
    }
    for (const double wavelength : setup.wavelengths_nm) {
        if (!(wavelength > 0 && std::isfinite(wavelength))) {
            user_error("simulate: found a wavelength of {} nm, expected one above 0", wavelength);
        }
    }
    for (const double sigma : {setup.sigma_psi_deg, setup.sigma_delta_deg}) {
        if (!(sigma >= 0 && sigma <= 45)) {
            user_error(
                "simulate: found noise of {} degrees, expected a standard deviation from 0 "
                "to 45",
                sigma);
        }
    }
}

}  // namespace

Measurement simulate_ellipsometer(const Material& material, const SimulationSetup& setup) {
    check(setup);
    material.check();
    Measurement measurement;
    measurement.header = {
        {"sample", material.name},
        {"instrument", "virtual (simulated; no hardware was used)"},
        {"software", "drude " DRUDE_VERSION},
        {"noise_deg",
         format_double(setup.sigma_psi_deg) + "," + format_double(setup.sigma_delta_deg)},
        {"seed", std::to_string(setup.seed)},
    };
    if (!material.substrate.citation.empty()) {
        measurement.header.emplace_back("optical_constants", material.substrate.citation);
    }
    for (const double wavelength : setup.wavelengths_nm) {
        for (const double angle : setup.angles_deg) {
            const Reflection<double> r = reflect(material, wavelength, std::cos(angle * degree));
            if (!has_angles(r) || is_vacuum(material, wavelength)) {
                user_error(
                    "simulate: '{}' reflects nothing at {} nm and {} degrees: Psi and Delta "
                    "are not defined there",
                    material.name, wavelength, angle);
            }
            const auto noise = normal_pair(setup.seed, measurement.rows.size());
            MeasurementRow row;
            row.wavelength_nm = wavelength;
            row.angle_deg = angle;
            row.psi_deg = psi(r) / degree;
            row.delta_deg = delta(r) / degree;
            row.sigma_psi_deg = setup.sigma_psi_deg;
            row.sigma_delta_deg = setup.sigma_delta_deg;
            add_noise(&row, setup.sigma_psi_deg * noise[0], setup.sigma_delta_deg * noise[1]);
            measurement.rows.push_back(row);
        }
    }
    measurement.check();
    return measurement;
}

}  // namespace drude
