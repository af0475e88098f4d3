#include "device/instruments/scpi_head.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.h"
#include "device/device_error.h"
#include "device/instruments/scpi_link.h"

namespace drude {

namespace {

// Goniometers are slow, and so are heads that turn elements for every wavelength.
constexpr double move_s = 120, measure_s = 600;

class ScpiHead : public PsiDeltaHead {
  public:
    ScpiHead(std::shared_ptr<UsbPort> port, const ScpiCommands& commands)
        : link_(std::move(port), commands), wavelengths_nm_(link_.wavelengths()) {
        uri_ = link_.uri();
    }

    std::string uri() const override { return uri_; }
    std::string identity() const override { return link_.identity().str(); }

    std::vector<MeasurementRow> measure(double incidence_deg) override {
        if (!(incidence_deg > 0 && incidence_deg < 90)) {
            user_error("{}: an angle of incidence of {} degrees; expected one between 0 and 90",
                       link_.name(), incidence_deg);
        }
        const ScpiCommands& commands = link_.commands();
        link_.command(scpi_command(commands.angle, format_double(incidence_deg)), move_s);
        return scpi_rows(link_.ask_numbers(commands.psi_delta, measure_s), wavelengths_nm_,
                         incidence_deg, link_.name());
    }
    void recover() override { link_.recover(); }
    bool reconnect(double seconds) override { return link_.reconnect(seconds); }

  private:
    ScpiLink link_;
    std::vector<double> wavelengths_nm_;
    std::string uri_;
};

}  // namespace

std::vector<MeasurementRow> scpi_rows(const std::vector<double>& numbers,
                                      const std::vector<double>& wavelengths_nm,
                                      double incidence_deg, const std::string& where) {
    const size_t count = wavelengths_nm.size();
    const size_t columns = count > 0 && numbers.size() % count == 0 ? numbers.size() / count : 0;
    if (columns != 3 && columns != 5 && columns != 6) {
        device_error(Fault::bad_frame,
                     "{}: answered {} numbers for {} wavelengths; expected 3, 5 or 6 of each: "
                     "wavelength, psi, delta[, sigma_psi, sigma_delta[, depolarization]]",
                     where, numbers.size(), count);
    }
    const auto or_unknown = [](double value, double unknown) {
        return std::isnan(value) ? unknown : value;
    };
    std::vector<MeasurementRow> rows;
    for (size_t i = 0; i < count; ++i) {
        const double* number = numbers.data() + i * columns;
        MeasurementRow row;
        row.wavelength_nm = number[0];
        row.angle_deg = incidence_deg;
        row.psi_deg = number[1];
        row.delta_deg = number[2];
        if (columns > 3) {
            row.sigma_psi_deg = or_unknown(number[3], 0);
            row.sigma_delta_deg = or_unknown(number[4], 0);
        }
        if (columns > 5) row.depolarization = or_unknown(number[5], -1);
        // Floats of 32 bits are exact to 6e-8 of themselves.
        if (!(std::abs(row.wavelength_nm - wavelengths_nm[i]) <= 0.01)) {
            device_error(Fault::bad_frame, "{}: row {} is of {} nm; expected {} nm", where, i + 1,
                         row.wavelength_nm, wavelengths_nm[i]);
        }
        if (std::isnan(row.psi_deg) || std::isnan(row.delta_deg)) continue;
        const bool depolarization_ok =
            row.depolarization == -1 || (row.depolarization >= 0 && row.depolarization <= 1);
        if (!(row.psi_deg >= 0 && row.psi_deg <= 90) || !std::isfinite(row.delta_deg) ||
            !std::isfinite(row.sigma_psi_deg) || !std::isfinite(row.sigma_delta_deg) ||
            row.sigma_psi_deg < 0 || row.sigma_delta_deg < 0 || !depolarization_ok) {
            device_error(Fault::bad_frame,
                         "{}: at {} nm psi {}, delta {}, sigmas {} and {}, depolarization {}; "
                         "expected psi in 0 to 90, sigmas of 0 or more, depolarization in 0 to 1",
                         where, row.wavelength_nm, row.psi_deg, row.delta_deg, row.sigma_psi_deg,
                         row.sigma_delta_deg, row.depolarization);
        }
        row.wavelength_nm = wavelengths_nm[i];
        rows.push_back(row);
    }
    if (rows.empty()) {
        device_error(Fault::refused,
                     "{}: measured nothing at {} degrees: psi and delta are NaN at all {} "
                     "wavelengths; check lamp and sample",
                     where, incidence_deg, count);
    }
    return rows;
}

std::shared_ptr<PsiDeltaHead> open_scpi_head(std::shared_ptr<UsbPort> port,
                                             const ScpiCommands& commands) {
    return std::make_shared<ScpiHead>(std::move(port), commands);
}

}  // namespace drude
