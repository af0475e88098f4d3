#include "report/surface_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "report/markup.h"
#include "report/plot_scale.h"

namespace drude {

namespace {

constexpr int font_size = svg_font_size;

struct Spot {
    double x = 0, y = 0;
};

class SurfaceDrawing {
  public:
    explicit SurfaceDrawing(const SurfacePlot& plot) : plot_(plot) {
        const size_t nx = plot.grid_x.size(), ny = plot.grid_y.size();
        if (nx < 2 || ny < 2 || plot.grid_z.size() != nx * ny) {
            throw std::invalid_argument("surface_plot: the grid's shape is wrong");
        }
        Extent across, away, up;
        for (const double v : plot.grid_x) across.include(v, false);
        for (const double v : plot.grid_y) away.include(v, false);
        for (const double v : plot.grid_z) up.include(v, false);
        for (const SurfacePoint& p : plot.points) up.include(p.z, false);
        x_ = make_scale(plot.x, across, 0);
        y_ = make_scale(plot.y, away, 0);
        z_ = make_scale(plot.z, up, 0.04);
        // The floor is a parallelogram; heights go straight up.
        const double top = plot.title.empty() ? 14 : 40, bottom = plot.height - 50.0;
        origin_ = {58, bottom - 0.04 * plot.height};
        along_x_ = {0.66 * (plot.width - 92), 0.04 * plot.height};
        along_y_ = {0.34 * (plot.width - 92), -0.26 * plot.height};
        rise_ = origin_.y + along_y_.y - top;
    }

    std::string svg() {
        const std::string id = identifier(plot_.id);
        const std::string title = escape_markup(plot_.title);
        const int height = plot_.height + (plot_.grid_name.empty() ? 0 : 24);
        out_ = svg_head(id, plot_.width, height, plot_.title,
                        plot_.description.empty() ? plot_.title : plot_.description);
        if (!title.empty())
            add(R"(<text x="14" y="18" font-weight="600" font-size="{}">{}</text>)", font_size + 2,
                title);
        frame();
        surface();
        points();
        legend();
        add("</svg>\n");
        return std::move(out_);
    }

  private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    // Positions in [0, 1] of each axis to the page.
    Spot at(double u, double v, double w) const {
        return {origin_.x + u * along_x_.x + v * along_y_.x,
                origin_.y + u * along_x_.y + v * along_y_.y - w * rise_};
    }
    Spot place(double x, double y, double z) const { return at(x_(x), y_(y), z_(z)); }

    static std::string path(const std::vector<Spot>& spots) {
        std::string d;
        bool pen_down = false;
        for (const Spot& s : spots) {
            if (!std::isfinite(s.x) || !std::isfinite(s.y)) {
                pen_down = false;
                continue;
            }
            d += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", s.x, s.y);
            pen_down = true;
        }
        return d;
    }

    void frame() {
        // The floor and the two walls behind.
        add(R"(<path d="{}Z{}Z{}Z" fill="none" stroke="currentColor" opacity="0.3"/>)",
            path({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}),
            path({at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}),
            path({at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}));
        std::string rules;
        for (const Tick& tick : ticks_of(z_, 6)) {
            if (tick.label.empty()) continue;
            const double w = z_(tick.value);
            rules += path({at(0, 0, w), at(0, 1, w), at(1, 1, w)});
            const Spot s = at(0, 0, w);
            add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", s.x - 6, s.y + 4.5,
                tick.label);
        }
        for (const Tick& tick : ticks_of(x_, 6)) {
            if (tick.label.empty()) continue;
            const double u = x_(tick.value);
            rules += path({at(u, 0, 0), at(u, 1, 0), at(u, 1, 1)});
            const Spot s = at(u, 0, 0);
            add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", s.x, s.y + 17,
                tick.label);
        }
        for (const Tick& tick : ticks_of(y_, 5)) {
            if (tick.label.empty()) continue;
            const double v = y_(tick.value);
            rules += path({at(1, v, 0), at(0, v, 0), at(0, v, 1)});
            const Spot s = at(1, v, 0);
            add(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", s.x + 7, s.y + 6, tick.label);
        }
        add(R"(<path d="{}" fill="none" stroke="currentColor" opacity="0.13"/>)", rules);
        const Spot x = at(0.5, 0, 0), y = at(1, 0.5, 0), z = at(0, 0, 0.5);
        add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", x.x, x.y + 38,
            escape_markup(plot_.x.label));
        const double slope = std::atan2(along_y_.y, along_y_.x) * 57.29577951308232;
        add(R"s(<text transform="translate({:.1f} {:.1f}) rotate({:.1f})" text-anchor="middle">)s"
            "{}</text>",
            y.x + 42, y.y + 28, slope, escape_markup(plot_.y.label));
        add(R"s(<text transform="translate(15 {:.1f}) rotate(-90)" text-anchor="middle">)s"
            "{}</text>",
            z.y, escape_markup(plot_.z.label));
    }

    double height(size_t i, size_t j) const { return plot_.grid_z[j * plot_.grid_x.size() + i]; }

    void surface() {
        std::string lines;
        for (const double wanted : plot_.lines_y) {
            const auto found = std::find(plot_.grid_y.begin(), plot_.grid_y.end(), wanted);
            if (found == plot_.grid_y.end()) continue;
            const auto j = static_cast<size_t>(found - plot_.grid_y.begin());
            std::vector<Spot> spots;
            for (size_t i = 0; i < plot_.grid_x.size(); ++i)
                spots.push_back(place(plot_.grid_x[i], wanted, height(i, j)));
            lines += path(spots);
        }
        for (const double wanted : plot_.lines_x) {
            const auto found = std::find(plot_.grid_x.begin(), plot_.grid_x.end(), wanted);
            if (found == plot_.grid_x.end()) continue;
            const auto i = static_cast<size_t>(found - plot_.grid_x.begin());
            std::vector<Spot> spots;
            for (size_t j = 0; j < plot_.grid_y.size(); ++j)
                spots.push_back(place(wanted, plot_.grid_y[j], height(i, j)));
            lines += path(spots);
        }
        add(R"(<path d="{}" fill="none" stroke="currentColor" stroke-width="0.9" opacity="0.62" )"
            R"(stroke-linejoin="round"/>)",
            lines);
    }

    bool inside(const SurfacePoint& p) const {
        const auto within = [](double t) { return t >= -1e-9 && t <= 1 + 1e-9; };
        return within(x_(p.x)) && within(y_(p.y)) && std::isfinite(p.z);
    }

    void points() {
        std::vector<SurfacePoint> ordered;
        std::copy_if(plot_.points.begin(), plot_.points.end(), std::back_inserter(ordered),
                     [&](const SurfacePoint& p) { return inside(p); });
        std::stable_sort(ordered.begin(), ordered.end(),
                         [](const SurfacePoint& a, const SurfacePoint& b) { return a.y > b.y; });
        std::string stems, dots;
        for (const SurfacePoint& p : ordered) {
            const Spot s = place(p.x, p.y, p.z);
            if (std::isfinite(p.foot)) stems += path({place(p.x, p.y, p.foot), s});
            // Dots as round ends of lines without length: a third of the text of circles.
            dots += fmt::format("M{:.1f} {:.1f}h0", s.x, s.y);
        }
        const char* paint = "var(--series-0,#0072b2)";
        add(R"(<path d="{}" fill="none" style="stroke:{}" stroke-width="1" opacity="0.55"/>)",
            stems, paint);
        add(R"(<path d="{}" fill="none" style="stroke:{}" stroke-width="4" )"
            R"(stroke-linecap="round"/>)",
            dots, paint);
    }

    void legend() {
        if (plot_.grid_name.empty()) return;
        const double y = plot_.height + 12.0;
        const double second = 14 + 30 + 0.61 * font_size * 26;
        add(R"s(<circle cx="25" cy="{:.1f}" r="3" style="fill:var(--series-0,#0072b2)"/>)s",
            y - 4.5);
        add(R"(<text x="42" y="{:.1f}">{}</text>)", y, escape_markup(plot_.points_name));
        add(R"(<path d="M{:.1f} {:.1f}h22" stroke="currentColor" opacity="0.7"/>)", second,
            y - 4.5);
        add(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", second + 28, y,
            escape_markup(plot_.grid_name));
    }

    const SurfacePlot& plot_;
    std::string out_;
    Scale x_, y_, z_;
    Spot origin_, along_x_, along_y_;
    double rise_ = 0;
};

}  // namespace

std::string surface_plot(const SurfacePlot& plot) {
    return SurfaceDrawing(plot).svg();
}

}  // namespace drude
