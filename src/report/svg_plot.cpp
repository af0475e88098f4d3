#include "report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "report/markup.h"
#include "report/plot_scale.h"

namespace drude {

namespace {

constexpr std::array<const char*, 8> palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#8c7500", "#555555"};
constexpr int font_size = svg_font_size;
constexpr double legend_line = 20;

std::string paint(int colour) {
    const size_t i = static_cast<size_t>(colour) % palette.size();
    return fmt::format("var(--series-{},{})", i, palette[i]);
}

// About how wide `text` is set, in pixels; good enough to break a legend into lines.
double text_width(const std::string& text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    });
    return 0.61 * font_size * static_cast<double>(letters);
}

class Drawing {
  public:
    explicit Drawing(const Plot& plot) : plot_(plot) {
        check();
        number_colours();
        lay_out();
    }

    std::string svg() {
        const std::string id = identifier(plot_.id);
        const std::string title = plot_.title.empty() ? plot_.y.label : plot_.title;
        out_ = svg_head(id, plot_.width, total_height_, title,
                        plot_.description.empty() ? title : plot_.description);
        add(R"(<defs><clipPath id="{}-c"><rect x="{:.2f}" y="{:.2f}" width="{:.2f}" )"
            R"(height="{:.2f}"/></clipPath></defs>)",
            id, left_, top_, right_ - left_, bottom_ - top_);
        if (!plot_.title.empty())
            add(R"(<text x="{:.2f}" y="18" font-weight="600" font-size="{}">{}</text>)", left_,
                font_size + 2, escape_markup(plot_.title));
        axes();
        add(R"s(<g clip-path="url(#{}-c)" stroke-linejoin="round" stroke-linecap="round">)s", id);
        for (const Band& band : plot_.bands) draw(band);
        for (const Series& series : plot_.series) draw(series);
        add("</g>");
        if (nothing_)
            add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="middle" opacity="0.6">no data</text>)",
                0.5 * (left_ + right_), 0.5 * (top_ + bottom_));
        legend();
        add("</svg>\n");
        return std::move(out_);
    }

  private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    void check() const {
        for (const Series& s : plot_.series) {
            if (s.x.size() != s.y.size() || (!s.error.empty() && s.error.size() != s.y.size()))
                throw std::invalid_argument("svg_plot: lengths differ in series " + s.name);
        }
        for (const Band& b : plot_.bands) {
            if (b.x.size() != b.low.size() || b.x.size() != b.high.size())
                throw std::invalid_argument("svg_plot: lengths differ in band " + b.name);
        }
    }

    void number_colours() {
        int next = 0;
        for (Band& b : plot_.bands)
            if (b.colour < 0) b.colour = next++;
        for (Series& s : plot_.series)
            if (s.colour < 0) s.colour = next++;
    }

    void lay_out() {
        Extent across, up;
        const auto each_x = [&](const std::vector<double>& xs) {
            for (const double x : xs) across.include(x, plot_.x.logarithmic);
        };
        for (const Series& s : plot_.series) each_x(s.x);
        for (const Band& b : plot_.bands) each_x(b.x);
        nothing_ = across.empty();
        x_ = make_scale(plot_.x, across, 0);
        // Heights outside a fixed range of x do not count.
        const auto seen = [&](double x) {
            const double t = x_(x);
            return t >= -1e-9 && t <= 1 + 1e-9;
        };
        const bool log_y = plot_.y.logarithmic;
        for (const Series& s : plot_.series) {
            for (size_t i = 0; i < s.x.size(); ++i) {
                if (!seen(s.x[i])) continue;
                const double e = s.error.empty() || !std::isfinite(s.error[i]) ? 0 : s.error[i];
                up.include(s.y[i], log_y);
                up.include(s.y[i] - e, log_y);
                up.include(s.y[i] + e, log_y);
            }
        }
        for (const Band& b : plot_.bands) {
            for (size_t i = 0; i < b.x.size(); ++i) {
                if (!seen(b.x[i])) continue;
                up.include(b.low[i], log_y);
                up.include(b.high[i], log_y);
            }
        }
        nothing_ |= up.empty();
        y_ = make_scale(plot_.y, up, 0.05);

        top_ = plot_.title.empty() ? 12 : 32;
        bottom_ = plot_.height - (plot_.x.label.empty() ? 28 : 48);
        bottom_ = std::max(bottom_, top_ + 20);
        x_ticks_ = ticks_of(x_, std::max(2, plot_.width / 70));
        y_ticks_ = ticks_of(y_, std::max(2, static_cast<int>((bottom_ - top_) / 38)));
        double label_width = 0;
        for (const Tick& tick : y_ticks_)
            label_width = std::max(label_width, text_width(tick.label));
        left_ = label_width + (plot_.y.label.empty() ? 12 : 32);
        right_ = std::max(plot_.width - 14.0, left_ + 20);
        x_.start = left_, x_.stop = right_;
        y_.start = bottom_, y_.stop = top_;
        lay_out_legend();
    }

    struct Entry {
        std::string name;
        int colour;
        bool band;
        Mark mark;
        bool dashed;
        double x, y;
    };

    void lay_out_legend() {
        double x = left_, y = plot_.height + 12.0;
        const auto place = [&](Entry entry) {
            if (entry.name.empty()) return;
            const double advance = 30 + text_width(entry.name) + 16;
            if (x > left_ && x + advance > right_ + 16) x = left_, y += legend_line;
            entry.x = x, entry.y = y;
            x += advance;
            legend_.push_back(std::move(entry));
        };
        for (const Band& b : plot_.bands) place({b.name, b.colour, true, Mark::line, false, 0, 0});
        for (const Series& s : plot_.series)
            place({s.name, s.colour, false, s.mark, s.dashed, 0, 0});
        total_height_ = legend_.empty() ? plot_.height : y + 10;
    }

    void axes() {
        for (const Tick& tick : x_ticks_) {
            const double x = x_(tick.value);
            add(R"(<path d="M{:.2f} {:.2f}V{:.2f}" stroke="currentColor" opacity="{}"/>)", x, top_,
                bottom_, tick.label.empty() ? 0.06 : 0.13);
            if (!tick.label.empty())
                add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>)", x,
                    bottom_ + 18, escape_markup(tick.label));
        }
        for (const Tick& tick : y_ticks_) {
            const double y = y_(tick.value);
            add(R"(<path d="M{:.2f} {:.2f}H{:.2f}" stroke="currentColor" opacity="{}"/>)", left_, y,
                right_, tick.label.empty() ? 0.06 : 0.13);
            if (!tick.label.empty())
                add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="end">{}</text>)", left_ - 7,
                    y + 0.35 * font_size, escape_markup(tick.label));
        }
        add(R"(<path d="M{:.2f} {:.2f}V{:.2f}H{:.2f}" fill="none" stroke="currentColor" )"
            R"(opacity="0.55"/>)",
            left_, top_, bottom_, right_);
        if (!plot_.x.label.empty())
            add(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>)",
                0.5 * (left_ + right_), bottom_ + 38, escape_markup(plot_.x.label));
        if (!plot_.y.label.empty()) {
            const double y = 0.5 * (top_ + bottom_);
            add(R"s(<text x="14" y="{:.2f}" text-anchor="middle" transform="rotate(-90 14 {:.2f})">)s"
                "{}</text>",
                y, y, escape_markup(plot_.y.label));
        }
    }

    void draw(const Band& band) {
        // Each unbroken stretch: along the top, back along the bottom.
        std::string above;
        std::vector<std::pair<double, double>> below;
        const auto close = [&] {
            if (below.size() > 1) {
                for (auto it = below.rbegin(); it != below.rend(); ++it)
                    above += fmt::format("L{:.2f} {:.2f}", it->first, it->second);
                add(R"(<path d="{}Z" style="fill:{}" fill-opacity="0.2"/>)", above,
                    paint(band.colour));
            }
            above.clear();
            below.clear();
        };
        for (size_t i = 0; i < band.x.size(); ++i) {
            const double x = x_(band.x[i]), low = y_(band.low[i]), high = y_(band.high[i]);
            if (std::isnan(x) || std::isnan(low) || std::isnan(high)) {
                close();
                continue;
            }
            above += fmt::format("{}{:.2f} {:.2f}", above.empty() ? "M" : "L", x, high);
            below.emplace_back(x, low);
        }
        close();
    }

    void draw(const Series& series) {
        switch (series.mark) {
            case Mark::line:
                return draw_line(series);
            case Mark::points:
                return draw_points(series);
            case Mark::rings:
                return draw_rings(series);
        }
    }

    void draw_rings(const Series& series) {
        for (size_t i = 0; i < series.x.size(); ++i) {
            const double x = x_(series.x[i]), y = y_(series.y[i]);
            if (std::isnan(x) || std::isnan(y)) continue;
            add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}" fill="none" style="stroke:{}" )"
                R"(stroke-width="2"/>)",
                x, y, series.width, paint(series.colour));
        }
    }

    void draw_line(const Series& series) {
        std::string path;
        bool pen_down = false;
        for (size_t i = 0; i < series.x.size(); ++i) {
            const double x = x_(series.x[i]), y = y_(series.y[i]);
            if (std::isnan(x) || std::isnan(y)) {
                pen_down = false;
                continue;
            }
            // A stretch of one point still shows: a line of no length with round ends.
            path +=
                fmt::format("{}{:.2f} {:.2f}{}", pen_down ? "L" : "M", x, y, pen_down ? "" : "h0");
            pen_down = true;
        }
        if (path.empty()) return;
        add(R"(<path d="{}" fill="none" style="stroke:{}" stroke-width="{:.2f}" opacity="{:.2f}"{}/>)",
            path, paint(series.colour), series.width, series.opacity,
            series.dashed ? R"( stroke-dasharray="5 4")" : "");
    }

    void draw_points(const Series& series) {
        std::string bars, dots;
        for (size_t i = 0; i < series.x.size(); ++i) {
            const double x = x_(series.x[i]), y = y_(series.y[i]);
            if (std::isnan(x) || std::isnan(y)) continue;
            dots +=
                fmt::format(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}"/>)", x, y, series.width);
            if (series.error.empty() || !(series.error[i] > 0)) continue;
            double low = y_(series.y[i] - series.error[i]);
            const double high = y_(series.y[i] + series.error[i]);
            if (std::isnan(low)) low = bottom_;  // reaches below what a logarithmic axis shows
            if (std::isnan(high)) continue;
            bars += fmt::format("M{0:.2f} {2:.2f}h4M{1:.2f} {2:.2f}V{3:.2f}M{0:.2f} {3:.2f}h4",
                                x - 2, x, low, high);
        }
        if (!bars.empty())
            add(R"(<path d="{}" fill="none" style="stroke:{}" stroke-width="1"/>)", bars,
                paint(series.colour));
        if (!dots.empty()) add(R"(<g style="fill:{}">{}</g>)", paint(series.colour), dots);
    }

    void legend() {
        for (const Entry& entry : legend_) {
            const std::string colour = paint(entry.colour);
            const double y = entry.y - 4.5;
            if (entry.band) {
                add(R"(<rect x="{:.2f}" y="{:.2f}" width="22" height="9" style="fill:{}" )"
                    R"(fill-opacity="0.3"/>)",
                    entry.x, y - 4.5, colour);
            } else if (entry.mark == Mark::rings) {
                add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="5" fill="none" style="stroke:{}" )"
                    R"(stroke-width="2"/>)",
                    entry.x + 11, y, colour);
            } else if (entry.mark == Mark::points) {
                add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="3.2" style="fill:{}"/>)", entry.x + 11, y,
                    colour);
            } else {
                add(R"(<path d="M{:.2f} {:.2f}h22" style="stroke:{}" stroke-width="2.2"{}/>)",
                    entry.x, y, colour, entry.dashed ? R"( stroke-dasharray="5 4")" : "");
            }
            add(R"(<text x="{:.2f}" y="{:.2f}">{}</text>)", entry.x + 28, entry.y,
                escape_markup(entry.name));
        }
    }

    Plot plot_;
    std::string out_;
    bool nothing_ = false;
    Scale x_, y_;
    std::vector<Tick> x_ticks_, y_ticks_;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0, total_height_ = 0;
    std::vector<Entry> legend_;
};

}  // namespace

std::string svg_plot(const Plot& plot) {
    return Drawing(plot).svg();
}

}  // namespace drude
