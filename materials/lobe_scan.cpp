#include "materials/lobe_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/text_table.h"
#include "materials/scalar.h"

namespace drude {

namespace {

const std::vector<std::string>& column_names() {
    static const std::vector<std::string> names = {"wavelength_nm", "angle_deg",     "offset_deg",
                                                   "reflectance_s", "reflectance_p", "sigma_s",
                                                   "sigma_p"};
    return names;
}

constexpr const char* solid_angle_key = "detector_solid_angle_sr";
constexpr const char* half_angle_key = "detector_half_angle_deg";

double detector_value(const TextTable& table, const char* key) {
    const std::string text = table.header_value(key);
    if (text.empty()) {
        user_error(
            "{}: found no header line '# {}: ...', expected one: a lobe means nothing without "
            "the detector's aperture",
            table.file, key);
    }
    const auto value = parse_double(text);
    if (!value) user_error("{}: found {} = '{}', expected a number", table.file, key, text);
    return *value;
}

void check_columns(const TextTable& table) {
    const auto& known = column_names();
    if (table.column("psi_deg") >= 0) {
        user_error(
            "{}: found a measurement of Psi and Delta, expected a lobe scan with the columns "
            "{}",
            table.file, fmt::join(known, ","));
    }
    for (const std::string& name : table.columns) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            user_error("{}: found the column '{}'{}, expected {}", table.file, name,
                       did_you_mean(name, known), fmt::join(known, ","));
        }
    }
    for (const std::string& name : known) {
        if (table.column(name) < 0) {
            user_error("{}: found no column '{}', expected {}", table.file, name,
                       fmt::join(known, ","));
        }
    }
}

void check_row(const LobeScanRow& row, const Place& place) {
    const auto bound = [&](bool good, const char* what, double value, const char* range) {
        if (!good) user_error_at(place, "found {} = {}, expected {}", what, value, range);
    };
    bound(row.wavelength_nm > 0 && std::isfinite(row.wavelength_nm), "wavelength_nm",
          row.wavelength_nm, "a vacuum wavelength above 0");
    bound(row.angle_deg > 0 && row.angle_deg < 90, "angle_deg", row.angle_deg,
          "an angle of incidence above 0 and below 90");
    const double seen = row.angle_deg + row.offset_deg;
    bound(seen > -90 && seen < 90, "offset_deg", row.offset_deg,
          "one that leaves the detector less than 90 degrees from the normal");
    bound(std::isfinite(row.reflectance_s), "reflectance_s", row.reflectance_s, "a finite number");
    bound(std::isfinite(row.reflectance_p), "reflectance_p", row.reflectance_p, "a finite number");
    bound(row.sigma_s > 0 && std::isfinite(row.sigma_s), "sigma_s", row.sigma_s,
          "a standard deviation above 0");
    bound(row.sigma_p > 0 && std::isfinite(row.sigma_p), "sigma_p", row.sigma_p,
          "a standard deviation above 0");
}

}  // namespace

void LobeScan::check() const {
    const std::string name = file.empty() ? "lobe scan" : file;
    if (!(detector_solid_angle_sr > 0 && detector_solid_angle_sr < 2 * pi)) {
        user_error("{}: found {} = {}, expected a solid angle above 0 and below 2 pi", name,
                   solid_angle_key, detector_solid_angle_sr);
    }
    if (!(detector_half_angle_deg > 0 && detector_half_angle_deg < 90)) {
        user_error("{}: found {} = {}, expected an angle above 0 and below 90", name,
                   half_angle_key, detector_half_angle_deg);
    }
    if (rows.empty()) user_error("{}: found no rows, expected a scan of the lobe", name);
    std::map<std::tuple<double, double, double>, size_t> seen;
    for (size_t i = 0; i < rows.size(); ++i) {
        const LobeScanRow& row = rows[i];
        const Place place = row_place(name, row.line, i);
        check_row(row, place);
        const auto [known, is_new] =
            seen.insert({{row.wavelength_nm, row.angle_deg, row.offset_deg}, i});
        if (is_new) continue;
        const LobeScanRow& first = rows[known->second];
        user_error_at(place,
                      "found {} nm at {} degrees, offset {}, twice, first on {}; expected every "
                      "position once: average or remove one of them",
                      row.wavelength_nm, row.angle_deg, row.offset_deg,
                      row_name(first.line, known->second));
    }
}

LobeScan parse_lobe_scan(const std::string& text, const std::string& file) {
    const TextTable table = parse_text_table(text, file);
    check_columns(table);
    LobeScan scan;
    scan.file = file;
    scan.header = table.header;
    scan.detector_solid_angle_sr = detector_value(table, solid_angle_key);
    scan.detector_half_angle_deg = detector_value(table, half_angle_key);
    for (const TableRow& values : table.rows) {
        const auto field = [&](size_t column) {
            return values.values[static_cast<size_t>(table.column(column_names()[column]))];
        };
        scan.rows.push_back(
            {field(0), field(1), field(2), field(3), field(4), field(5), field(6), values.line});
    }
    scan.check();
    return scan;
}

LobeScan read_lobe_scan(const std::string& path) {
    return parse_lobe_scan(read_file(path), path);
}

std::string format_lobe_scan(const LobeScan& scan) {
    scan.check();
    std::string text;
    for (const auto& [key, value] : scan.header) {
        if (key == solid_angle_key || key == half_angle_key) continue;
        text += format_header_line(key, value);
    }
    text +=
        fmt::format("# {}: {}\n# {}: {}\n{}\n", solid_angle_key,
                    format_double(scan.detector_solid_angle_sr), half_angle_key,
                    format_double(scan.detector_half_angle_deg), fmt::join(column_names(), ","));
    for (const LobeScanRow& row : scan.rows) {
        text += fmt::format("{},{},{},{},{},{},{}\n", format_double(row.wavelength_nm),
                            format_double(row.angle_deg), format_double(row.offset_deg),
                            format_double(row.reflectance_s), format_double(row.reflectance_p),
                            format_double(row.sigma_s), format_double(row.sigma_p));
    }
    return text;
}

}  // namespace drude
