#include "fitter/import_accurion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fitter/import_text.h"

namespace drude {

namespace {

enum Column : size_t { lambda, aoi, psi, delta, zone, column_count };
constexpr std::array<const char*, column_count> names = {"lambda", "aoi", "psi", "delta", "zone"};
constexpr int absent = -1;

struct Columns {
    std::array<int, column_count> at;
};

// The columns of a line of names. `place` for errors; without it nothing is thrown.
Columns find_columns(std::string_view line, const Place* place) {
    Columns columns;
    columns.at.fill(absent);
    const std::vector<Word> fields = split_fields(line, '\t');
    for (size_t i = 0; i < fields.size(); ++i) {
        std::string name = lower_case(fields[i].text);
        if (i == 0 && !name.empty() && name[0] == '#') name.erase(0, 1);
        for (size_t c = 0; c < column_count; ++c) {
            if (name != names[c]) continue;
            if (columns.at[c] != absent && place) {
                user_error_at({place->file, place->line, fields[i].column},
                              "found the column '{}' twice", shown(fields[i].text));
            }
            columns.at[c] = static_cast<int>(i);
        }
    }
    return columns;
}

bool complete(const Columns& columns) {
    return std::all_of(columns.at.begin(), columns.at.begin() + zone,
                       [](int at) { return at != absent; });
}

// The line below the names: units start with "#" or hold no number where the wavelengths are.
bool is_unit_line(std::string_view line, const Columns& columns) {
    const std::vector<Word> fields = split_fields(line, '\t');
    if (!fields[0].text.empty() && fields[0].text[0] == '#') return true;
    const auto at = static_cast<size_t>(columns.at[lambda]);
    return at >= fields.size() || (!number_in(fields[at].text) && fields[at].text.size() < 4 &&
                                   lower_case(fields[at].text) != "nan");
}

void check_units(std::string_view line, const Columns& columns, const Place& place) {
    const std::vector<Word> fields = split_fields(line, '\t');
    for (const size_t c : {lambda, aoi, psi, delta}) {
        const auto at = static_cast<size_t>(columns.at[c]);
        if (at >= fields.size()) continue;
        std::string unit = lower_case(fields[at].text);
        if (!unit.empty() && unit[0] == '#') unit.erase(0, 1);
        const char* expected = c == lambda ? "nm" : "deg";
        if (!unit.empty() && unit != "-" && unit != expected) {
            user_error_at({place.file, place.line, fields[at].column},
                          "found {} in '{}', expected {}", names[c], shown(fields[at].text),
                          expected);
        }
    }
}

struct Sample {
    double psi = 0, delta = 0;
    int zone = 0, line = 0;
};
// The zones of one point. Points keep the order in which they come.
struct Point {
    double wavelength = 0, angle = 0;
    std::vector<Sample> samples;
};

class Points {
  public:
    void add(double wavelength, double angle, const Sample& sample, const Place& place) {
        const auto [at, is_new] = index_.emplace(std::pair(wavelength, angle), points_.size());
        if (is_new) points_.push_back({wavelength, angle, {}});
        Point& point = points_[at->second];
        for (const Sample& other : point.samples) {
            if (other.zone != sample.zone) continue;
            user_error_at(place,
                          "found {} nm at {} degrees twice in the same zone, on line {} and on "
                          "line {}: a map, several regions or a series in time; expected one "
                          "point of the sample: export one",
                          wavelength, angle, other.line, sample.line);
        }
        point.samples.push_back(sample);
    }
    const std::vector<Point>& get() const { return points_; }

  private:
    std::map<std::pair<double, double>, size_t> index_;
    std::vector<Point> points_;
};

MeasurementRow mean(const Point& point) {
    MeasurementRow row;
    row.wavelength_nm = point.wavelength;
    row.angle_deg = point.angle;
    row.line = point.samples.front().line;
    // Around the first Delta, so that 359 and 1 do not become 180.
    const double first = point.samples.front().delta;
    double offset = 0;
    for (const Sample& sample : point.samples) {
        row.psi_deg += sample.psi;
        offset += std::remainder(sample.delta - first, 360.0);
    }
    const double count = static_cast<double>(point.samples.size());
    row.psi_deg /= count;
    row.delta_deg = first + offset / count;
    return row;
}

// Reads one row into the zones or the instrument's own means; counts it where it holds NaN.
struct RowReader {
    Columns columns;
    Points zones, means;
    size_t rows = 0, nan_rows = 0;

    void read(const TextLine& line, const std::string& file) {
        const std::vector<Word> fields = split_fields(line.text, '\t');
        const Place place{file, line.number, 0};
        for (size_t c = 0; c < column_count; ++c) {
            if (columns.at[c] != absent && static_cast<size_t>(columns.at[c]) >= fields.size()) {
                user_error_at(place, "found {} fields, expected {} in field {}", fields.size(),
                              names[c], columns.at[c] + 1);
            }
        }
        const auto field = [&](Column c) { return fields[static_cast<size_t>(columns.at[c])]; };
        Sample sample;
        sample.line = line.number;
        const bool has_zone = columns.at[zone] != absent;
        if (has_zone) {
            const double value = parse_number(field(zone), place);
            if (!(value >= 0 && value <= 5) || value != std::floor(value)) {
                user_error_at({file, line.number, field(zone).column},
                              "found the zone {}, expected 0 to 5", value);
            }
            sample.zone = static_cast<int>(value);
        }
        if (sample.zone == 5) return;
        ++rows;
        for (const Column c : {lambda, aoi, psi, delta}) {
            if (lower_case(field(c).text) == "nan") {
                ++nan_rows;
                return;
            }
        }
        const double wavelength = parse_wavelength_nm(field(lambda), place, SpectralUnit::nm);
        sample.psi = parse_number(field(psi), place);
        sample.delta = parse_number(field(delta), place);
        const double angle = parse_number(field(aoi), place);
        (sample.zone == 0 ? means : zones).add(wavelength, angle, sample, place);
    }
};

}  // namespace

bool is_accurion(const std::string& text) {
    for (const TextLine& line : lines_of(std::string_view(text).substr(0, 16384))) {
        if (split_blanks(line.text).empty()) continue;
        return line.text.find('\t') != line.text.npos &&
               line.text[line.text.find_first_not_of(" \t")] == '#' &&
               complete(find_columns(line.text, nullptr));
    }
    return false;
}

Measurement parse_accurion(const std::string& text, const std::string& file) {
    RowReader reader;
    bool named = false, below_names = false;
    for (const TextLine& line : lines_of(text)) {
        const Place place{file, line.number, 0};
        if (named && below_names && split_blanks(line.text).empty()) below_names = false;
        if (split_blanks(line.text).empty()) continue;
        if (!named) {
            reader.columns = find_columns(line.text, &place);
            for (size_t c = 0; c < zone; ++c) {
                if (reader.columns.at[c] != absent) continue;
                user_error_at(place,
                              "found no column '{}', expected Lambda, AOI, Psi and Delta among "
                              "names separated by tabs",
                              names[c]);
            }
            named = below_names = true;
        } else if (below_names && is_unit_line(line.text, reader.columns)) {
            check_units(line.text, reader.columns, place);
            below_names = false;
        } else {
            below_names = false;
            reader.read(line, file);
        }
    }
    if (!named) user_error("{}: found an empty file, expected names of columns", file);

    Measurement measurement;
    measurement.file = file;
    measurement.header = {{"imported_from", "Accurion"}};
    const bool has_zones = !reader.zones.get().empty();
    const std::vector<Point>& points = has_zones ? reader.zones.get() : reader.means.get();
    size_t most = 0, fewer = 0;
    for (const Point& point : points) {
        measurement.rows.push_back(mean(point));
        most = std::max(most, point.samples.size());
    }
    for (const Point& point : points) fewer += point.samples.size() < most ? 1 : 0;
    if (points.empty()) {
        user_error("{}: found {} rows, all of them with NaN; expected numbers", file, reader.rows);
    }
    if (most > 1) measurement.header.emplace_back("zones_averaged", fmt::format("{}", most));
    if (reader.nan_rows > 0) {
        add_warning(measurement, fmt::format("{} of {} rows hold NaN and were left out",
                                             reader.nan_rows, reader.rows));
    }
    if (fewer > 0) {
        add_warning(measurement,
                    fmt::format("{} of {} points have fewer than {} zones: their mean keeps errors "
                                "of the instrument that four zones cancel",
                                fewer, points.size(), most));
    }
    measurement.check();
    return measurement;
}

}  // namespace drude
