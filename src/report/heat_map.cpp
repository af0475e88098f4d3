#include "report/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "image/colour_map.h"
#include "image/srgb.h"
#include "report/markup.h"
#include "report/plot_scale.h"

namespace drude {

namespace {

constexpr double top = 54, bar_width = 14, bar_space = 76, letter = 7.5;

std::string hex(const Colour& linear) {
    std::string text = "#";
    for (const float c : linear) text += fmt::format("{:02x}", srgb_byte(c));
    return text;
}

class Drawing {
  public:
    explicit Drawing(const HeatMap& map) : map_(map), id_(identifier(map.id)) {
        if (map.at_x.empty() || map.at_y.empty() ||
            map.cells.size() != map.at_x.size() * map.at_y.size()) {
            throw std::invalid_argument("heat_map: cells and grid differ in " + map.id);
        }
        for (size_t i = 0; i < map.at_x.size(); ++i) {
            words_x_.push_back(i < map.names_x.size() ? map.names_x[i] : label(map.at_x[i]));
        }
        double widest = 0;
        for (size_t i = 0; i < map.at_y.size(); ++i) {
            words_y_.push_back(i < map.names_y.size() ? map.names_y[i] : label(map.at_y[i]));
            widest = std::max(widest, letter * static_cast<double>(words_y_.back().size()));
        }
        left_ = 36 + widest;
        right_ = map.width - bar_space;
        bottom_ = map.height - 48.0;
        x_ = edges(map.at_x.size(), left_, right_);
        y_ = edges(map.at_y.size(), bottom_, top);
        range();
    }

    std::string svg() {
        head();
        cells();
        border();
        axis_labels();
        bar();
        legend();
        add("</svg>\n");
        return std::move(out_);
    }

  private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    // Where the cells of one side begin and end: evenly wide, whatever the values.
    static std::vector<double> edges(size_t count, double start, double stop) {
        std::vector<double> at;
        for (size_t i = 0; i <= count; ++i) {
            at.push_back(start +
                         (stop - start) * static_cast<double>(i) / static_cast<double>(count));
        }
        return at;
    }

    void range() {
        Extent extent;
        for (const HeatCell& cell : map_.cells) {
            if (!cell.hatched) extent.include(cell.value, true);
        }
        if (map_.bound > 0) extent.include(map_.bound, true);
        if (extent.empty()) extent.low = 1e-8, extent.high = 1;
        low_ = std::floor(std::log10(extent.low) + 1e-9);
        high_ = std::max(low_ + 1, std::ceil(std::log10(extent.high) - 1e-9));
    }

    double position(double value) const {
        if (!std::isfinite(value)) return std::nan("");
        return value > 0 ? (std::log10(value) - low_) / (high_ - low_) : 0;
    }

    void head() {
        // The legend stands beneath the axes, a line each.
        const int lines = !map_.hatched.empty() + !map_.outside.empty();
        out_ = svg_head(id_, map_.width, map_.height + 20 * lines, map_.title,
                        map_.description.empty() ? map_.title : map_.description);
        add(R"(<defs><pattern id="{}-h" width="6" height="6" patternUnits="userSpaceOnUse">)"
            R"(<path d="M0 6L6 0" stroke="currentColor" opacity="0.5"/></pattern></defs>)",
            id_);
        add(R"(<text x="{}" y="20" font-weight="600" font-size="15">{}</text>)", left_,
            escape_markup(map_.title));
    }

    void cells() {
        const size_t nx = map_.at_x.size();
        for (size_t i = 0; i < map_.cells.size(); ++i) {
            const HeatCell& cell = map_.cells[i];
            const size_t ix = i % nx, iy = i / nx;
            const std::string fill =
                cell.hatched ? fmt::format("url(#{}-h)", id_)
                             : hex(map_colour(ColourMap::sequential, position(cell.value)));
            add(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}">)"
                "<title>{}, {}: {}</title></rect>",
                x_[ix], y_[iy + 1], x_[ix + 1] - x_[ix] + 0.3, y_[iy] - y_[iy + 1] + 0.3, fill,
                escape_markup(words_x_[ix]), escape_markup(words_y_[iy]),
                cell.hatched ? "refused" : label(cell.value));
        }
    }

    static std::string label(double value) { return fmt::format("{:.3g}", value); }

    void border() {
        const size_t nx = map_.at_x.size(), ny = map_.at_y.size();
        const auto inside = [&](size_t ix, size_t iy) { return map_.cells[iy * nx + ix].inside; };
        std::string path;
        for (size_t iy = 0; iy < ny; ++iy) {
            for (size_t ix = 0; ix < nx; ++ix) {
                if (ix + 1 < nx && inside(ix, iy) != inside(ix + 1, iy)) {
                    path += fmt::format("M{:.2f} {:.2f}V{:.2f}", x_[ix + 1], y_[iy], y_[iy + 1]);
                }
                if (iy + 1 < ny && inside(ix, iy) != inside(ix, iy + 1)) {
                    path += fmt::format("M{:.2f} {:.2f}H{:.2f}", x_[ix], y_[iy + 1], x_[ix + 1]);
                }
            }
        }
        if (path.empty()) return;
        // White within orange is seen on every colour of the map.
        add(R"(<path d="{0}" fill="none" stroke="#fff" stroke-width="5"/>)"
            R"(<path d="{0}" fill="none" stroke="#d55e00" stroke-width="2.5"/>)",
            path);
    }

    // A label at every cell where there is room for it, otherwise at every second, third, ...
    void axis_labels() {
        const auto every = [](size_t count, double room) {
            return std::max<size_t>(
                1, static_cast<size_t>(std::ceil(static_cast<double>(count) / room)));
        };
        const size_t step_x = every(map_.at_x.size(), (right_ - left_) / 52);
        for (size_t i = 0; i < map_.at_x.size(); i += step_x) {
            add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>)",
                0.5 * (x_[i] + x_[i + 1]), bottom_ + 17, escape_markup(words_x_[i]));
        }
        const size_t step_y = every(map_.at_y.size(), (bottom_ - top) / 18);
        for (size_t i = 0; i < map_.at_y.size(); i += step_y) {
            add(R"(<text x="{}" y="{:.2f}" text-anchor="end">{}</text>)", left_ - 7,
                0.5 * (y_[i] + y_[i + 1]) + 4.5, escape_markup(words_y_[i]));
        }
        add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>)", 0.5 * (left_ + right_),
            bottom_ + 38, escape_markup(map_.x));
        const double middle = 0.5 * (top + bottom_);
        add(R"s(<text x="14" y="{0:.2f}" text-anchor="middle" transform="rotate(-90 14 {0:.2f})">)s"
            "{1}</text>",
            middle, escape_markup(map_.y));
    }

    void bar() {
        constexpr int steps = 48;
        const double x = right_ + 16, height = bottom_ - top;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps;
            add(R"(<rect x="{:.2f}" y="{:.2f}" width="{}" height="{:.2f}" fill="{}"/>)", x,
                bottom_ - height * (i + 1) / steps, bar_width, height / steps + 0.3,
                hex(map_colour(ColourMap::sequential, t)));
        }
        const int decades = static_cast<int>(high_ - low_);
        const int step = std::max(1, (decades + 7) / 8);
        for (int d = 0; d <= decades; d += step) {
            add(R"(<text x="{:.2f}" y="{:.2f}">1e{}</text>)", x + bar_width + 6,
                bottom_ - height * d / decades + 4.5, static_cast<int>(low_) + d);
        }
        if (map_.bound > 0) {
            const double y = bottom_ - height * std::clamp(position(map_.bound), 0.0, 1.0);
            add(R"(<path d="M{:.2f} {:.2f}h{}" stroke="#fff" stroke-width="5"/>)"
                R"(<path d="M{:.2f} {:.2f}h{}" stroke="#d55e00" stroke-width="2.5"/>)",
                x - 4, y, bar_width + 8, x - 4, y, bar_width + 8);
        }
        add(R"(<text x="{}" y="{}" text-anchor="end" font-size="12">{}</text>)", map_.width - 4,
            top - 12, escape_markup(map_.value));
    }

    void legend() {
        double y = map_.height + 12.0;
        if (!map_.hatched.empty()) {
            add(R"s(<rect x="{}" y="{:.2f}" width="22" height="11" fill="url(#{}-h)" )s"
                R"(stroke="currentColor" stroke-opacity="0.5"/><text x="{}" y="{:.2f}">{}</text>)",
                left_, y - 10, id_, left_ + 28, y, escape_markup(map_.hatched));
            y += 20;
        }
        if (!map_.outside.empty()) {
            add(R"(<path d="M{} {:.2f}h22" stroke="#d55e00" stroke-width="2.5"/>)"
                R"(<text x="{}" y="{:.2f}">{}</text>)",
                left_, y - 4.5, left_ + 28, y, escape_markup(map_.outside));
        }
    }

    const HeatMap& map_;
    const std::string id_;
    std::string out_;
    std::vector<double> x_, y_;
    std::vector<std::string> words_x_, words_y_;
    double left_ = 0, right_ = 0, bottom_ = 0, low_ = 0, high_ = 1;
};

}  // namespace

std::string heat_map(const HeatMap& map) {
    return Drawing(map).svg();
}

}  // namespace drude
