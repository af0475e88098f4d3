#include "materials/measurement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/text_table.h"

namespace drude {

namespace {

const std::vector<std::string>& column_names() {
    static const std::vector<std::string> names = {
        "wavelength_nm", "angle_deg",       "psi_deg",       "delta_deg",
        "sigma_psi_deg", "sigma_delta_deg", "depolarization"};
    return names;
}
constexpr size_t required_columns = 4;

void check_columns(const TextTable& table) {
    if (table.column("offset_deg") >= 0 && table.column("reflectance_s") >= 0) {
        user_error(
            "{}: found a lobe scan (offset_deg, reflectance_s, ...), expected a measurement of "
            "Psi and Delta with the columns {}",
            table.file, fmt::join(column_names(), ","));
    }
    for (const std::string& name : table.columns) {
        const auto& known = column_names();
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            user_error("{}: found the column '{}'{}, expected {}", table.file, name,
                       did_you_mean(name, known), fmt::join(known, ","));
        }
    }
    for (size_t i = 0; i < required_columns; ++i) {
        if (table.column(column_names()[i]) < 0) {
            user_error(
                "{}: found no column '{}', expected wavelength_nm,angle_deg,psi_deg,"
                "delta_deg[,sigma_psi_deg,sigma_delta_deg[,depolarization]]",
                table.file, column_names()[i]);
        }
    }
    if ((table.column("sigma_psi_deg") < 0) != (table.column("sigma_delta_deg") < 0)) {
        user_error("{}: found only one of sigma_psi_deg and sigma_delta_deg, expected both or none",
                   table.file);
    }
}

std::vector<double> distinct(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

void check_row(const MeasurementRow& row, const Place& place) {
    const auto bound = [&](bool good, const char* what, double value, const char* range) {
        if (!good) user_error_at(place, "found {} = {}, expected {}", what, value, range);
    };
    bound(row.wavelength_nm >= 1 && std::isfinite(row.wavelength_nm), "wavelength_nm",
          row.wavelength_nm, "a vacuum wavelength of at least 1 nm (0.55 micrometres are 550)");
    bound(row.angle_deg > 0 && row.angle_deg < 90, "angle_deg", row.angle_deg,
          "an angle of incidence above 0 and below 90");
    bound(row.psi_deg >= 0 && row.psi_deg <= 90, "psi_deg", row.psi_deg, "a value from 0 to 90");
    bound(std::isfinite(row.delta_deg), "delta_deg", row.delta_deg, "a finite number of degrees");
    bound(row.sigma_psi_deg >= 0 && std::isfinite(row.sigma_psi_deg), "sigma_psi_deg",
          row.sigma_psi_deg, "a standard deviation of 0 (not known) or more");
    bound(row.sigma_delta_deg >= 0 && std::isfinite(row.sigma_delta_deg), "sigma_delta_deg",
          row.sigma_delta_deg, "a standard deviation of 0 (not known) or more");
    bound(row.depolarization == -1 || (row.depolarization >= 0 && row.depolarization <= 1),
          "depolarization", row.depolarization, "a value from 0 to 1 (-1: not known)");
}

}  // namespace

std::string Measurement::header_value(const std::string& key) const {
    for (const auto& [name, value] : header) {
        if (name == key) return value;
    }
    return {};
}

std::vector<double> Measurement::wavelengths() const {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const MeasurementRow& row : rows) values.push_back(row.wavelength_nm);
    return distinct(std::move(values));
}

std::vector<double> Measurement::angles() const {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const MeasurementRow& row : rows) values.push_back(row.angle_deg);
    return distinct(std::move(values));
}

bool Measurement::has_sigma() const {
    return !rows.empty() && std::all_of(rows.begin(), rows.end(), [](const MeasurementRow& row) {
        return row.sigma_psi_deg > 0 && row.sigma_delta_deg > 0;
    });
}

bool Measurement::has_depolarization() const {
    return !rows.empty() && std::all_of(rows.begin(), rows.end(), [](const MeasurementRow& row) {
        return row.depolarization >= 0;
    });
}

void Measurement::check() const {
    if (rows.empty()) {
        user_error("{}: found no rows, expected at least one wavelength and angle",
                   file.empty() ? "measurement" : file);
    }
    for (size_t i = 0; i < rows.size(); ++i) {
        check_row(rows[i], row_place(file.empty() ? "measurement" : file, rows[i].line, i));
    }
    std::vector<size_t> order(rows.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const MeasurementRow &x = rows[a], &y = rows[b];
        if (x.wavelength_nm != y.wavelength_nm) return x.wavelength_nm < y.wavelength_nm;
        if (x.angle_deg != y.angle_deg) return x.angle_deg < y.angle_deg;
        return a < b;
    });
    for (size_t i = 1; i < order.size(); ++i) {
        const MeasurementRow &first = rows[order[i - 1]], &second = rows[order[i]];
        if (first.wavelength_nm == second.wavelength_nm && first.angle_deg == second.angle_deg) {
            user_error_at({file.empty() ? "measurement" : file, second.line, 0},
                          "found {} nm at {} degrees twice, on {} and on {}; expected every "
                          "wavelength once at every angle: average or remove one of them",
                          second.wavelength_nm, second.angle_deg,
                          row_name(first.line, order[i - 1]), row_name(second.line, order[i]));
        }
    }
}

Measurement parse_measurement(const std::string& text, const std::string& file) {
    const TextTable table = parse_text_table(text, file);
    check_columns(table);
    Measurement measurement;
    measurement.file = file;
    measurement.header = table.header;
    std::vector<int> at;
    for (const std::string& name : column_names()) at.push_back(table.column(name));
    for (const TableRow& values : table.rows) {
        const auto field = [&](size_t column, double missing) {
            return at[column] < 0 ? missing : values.values[static_cast<size_t>(at[column])];
        };
        MeasurementRow row;
        row.wavelength_nm = field(0, 0);
        row.angle_deg = field(1, 0);
        row.psi_deg = field(2, 0);
        row.delta_deg = field(3, 0);
        row.sigma_psi_deg = field(4, 0);
        row.sigma_delta_deg = field(5, 0);
        row.depolarization = field(6, -1);
        row.line = values.line;
        measurement.rows.push_back(row);
    }
    measurement.check();
    return measurement;
}

Measurement read_measurement(const std::string& path) {
    return parse_measurement(read_file(path), path);
}

std::string format_measurement(const Measurement& measurement) {
    measurement.check();
    bool sigma = false, depolarization = false;
    for (const MeasurementRow& row : measurement.rows) {
        sigma = sigma || row.sigma_psi_deg > 0 || row.sigma_delta_deg > 0;
        depolarization = depolarization || row.depolarization >= 0;
    }
    std::string text;
    for (const auto& [key, value] : measurement.header) {
        text += format_header_line(key, value);
    }
    text += "wavelength_nm,angle_deg,psi_deg,delta_deg";
    if (sigma || depolarization) text += ",sigma_psi_deg,sigma_delta_deg";
    if (depolarization) text += ",depolarization";
    text += "\n";
    for (const MeasurementRow& row : measurement.rows) {
        text += fmt::format("{},{},{},{}", format_double(row.wavelength_nm),
                            format_double(row.angle_deg), format_double(row.psi_deg),
                            format_double(row.delta_deg));
        if (sigma || depolarization) {
            text += fmt::format(",{},{}", format_double(row.sigma_psi_deg),
                                format_double(row.sigma_delta_deg));
        }
        if (depolarization) text += fmt::format(",{}", format_double(row.depolarization));
        text += "\n";
    }
    return text;
}

void write_measurement(const std::string& path, const Measurement& measurement) {
    write_file(path, format_measurement(measurement));
}

}  // namespace drude
