#include "table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace {

class Reader {
  public:
    explicit Reader(const std::string& path) : path_(path) {
        std::ifstream file(path, std::ios::binary);
        text_.assign(std::istreambuf_iterator<char>(file), {});
        if (!file) throw std::runtime_error(path + ": cannot be read");
    }

    [[noreturn]] void fail(const std::string& what) const {
        const auto line =
            1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n');
        throw std::runtime_error(path_ + ":" + std::to_string(line) + ": " + what);
    }

    // "" at the end.
    std::string word() {
        skip();
        const size_t start = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(start, at_ - start);
    }
    void expect(const std::string& wanted) {
        const std::string found = word();
        if (found != wanted) fail("found '" + found.substr(0, 40) + "'; expected " + wanted);
    }
    float number() {
        skip();
        float value = 0;
        const auto [end, error] =
            std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error != std::errc() || !std::isfinite(value)) fail("expected a finite number");
        at_ = static_cast<size_t>(end - text_.data());
        if (at_ < text_.size() && !is_blank(text_[at_])) fail("expected a blank after the number");
        return value;
    }

    // "NAME COUNT VALUES", strictly ascending in [lowest, highest].
    std::vector<float> axis(const std::string& name, size_t least, float lowest, float highest) {
        expect(name);
        const float count = number();
        if (!(count >= static_cast<float>(least) && count <= 10000) || count != std::floor(count)) {
            fail(name + ": expected " + std::to_string(least) + " to 10000 values");
        }
        std::vector<float> values;
        for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
            values.push_back(number());
            if (!(values[i] >= lowest && values[i] <= highest)) {
                fail(name + ": expected values from " + std::to_string(lowest) + " to " +
                     std::to_string(highest));
            }
            if (i > 0 && !(values[i] > values[i - 1])) fail(name + ": expected ascending values");
        }
        return values;
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    void skip() {
        while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
            if (text_[at_] == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else {
                ++at_;
            }
        }
    }

    std::string path_, text_;
    size_t at_ = 0;
};

// Between nodes `first` and first + 1, `part` of the way.
struct Position {
    size_t first = 0;
    float part = 0;
};

Position locate(const std::vector<float>& axis, float value) {
    if (axis.size() == 1 || !(value > axis.front())) return {};
    const size_t last = axis.size() - 1;
    if (!(value < axis[last])) return {last - 1, 1};
    const auto above = std::upper_bound(axis.begin(), axis.end(), value);
    const size_t first = static_cast<size_t>(above - axis.begin()) - 1;
    return {first, (value - axis[first]) / (axis[first + 1] - axis[first])};
}

}  // namespace

Table Table::read(const std::string& path) {
    Reader in(path);
    in.expect("pbrdf-table");
    in.expect("1");
    Table table;
    table.wavelengths_nm = in.axis("wavelengths_nm", 1, 100, 10000);
    table.theta_h_deg = in.axis("theta_h_deg", 2, 0, 90);
    table.theta_d_deg = in.axis("theta_d_deg", 2, 0, 90);
    table.phi_d_deg = in.axis("phi_d_deg", 2, 0, 180);
    in.expect("values");
    const size_t matrices = table.theta_h_deg.size() * table.theta_d_deg.size() *
                            table.phi_d_deg.size() * table.wavelengths_nm.size();
    if (matrices > 50'000'000) in.fail("expected at most 50000000 matrices");
    for (size_t m = 0; m < matrices; ++m) {
        float first = 0;
        for (int j = 0; j < 16; ++j) {
            const float value = in.number();
            if (j == 0) first = value;
            if (!(first >= 0 && std::abs(value) <= 1.001f * first)) {
                in.fail("expected |M_ij| <= M_00 in every matrix");
            }
            table.values.push_back(value);
        }
    }
    if (const std::string more = in.word(); !more.empty()) {
        in.fail("found '" + more.substr(0, 40) + "'; expected the end of the file");
    }
    return table;
}

void Table::interpolate(float theta_h, float theta_d, float phi_d, const float* nm, int count,
                        float* mueller) const {
    const Position h = locate(theta_h_deg, theta_h), d = locate(theta_d_deg, theta_d),
                   p = locate(phi_d_deg, std::abs(phi_d));
    std::fill(mueller, mueller + 16 * count, 0.0f);
    for (int w = 0; w < count; ++w) {
        const Position c = locate(wavelengths_nm, nm[w]);
        float* m = mueller + 16 * w;
        for (size_t corner = 0; corner < 16; ++corner) {
            const size_t bit[4] = {corner & 1, corner >> 1 & 1, corner >> 2 & 1, corner >> 3 & 1};
            const Position* positions[4] = {&h, &d, &p, &c};
            float weight = 1;
            for (int a = 0; a < 4; ++a) {
                weight *= bit[a] ? positions[a]->part : 1 - positions[a]->part;
            }
            if (!(weight > 0)) continue;
            const size_t at =
                (((h.first + bit[0]) * theta_d_deg.size() + d.first + bit[1]) * phi_d_deg.size() +
                 p.first + bit[2]) *
                    wavelengths_nm.size() +
                c.first + bit[3];
            for (int j = 0; j < 16; ++j) m[j] += weight * values[16 * at + static_cast<size_t>(j)];
        }
        // A mirror turns S2 and S3 round, and leaves s and p where they are.
        if (phi_d < 0) {
            for (const int j : {2, 3, 6, 7, 8, 9, 12, 13}) m[j] = -m[j];
        }
    }
}
