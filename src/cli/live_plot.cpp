#include "cli/live_plot.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "base/progress.h"
#include "device/signal/reduction.h"
#include "device/sweep/journal_scans.h"

namespace drude {

namespace {

constexpr size_t plot_width = 60, plot_height = 8;

double mean_light(const JournalPoint& point, const JournalDark& dark) {
    const auto sum = [](const std::vector<Frame>& frames) {
        double total = 0;
        for (const Frame& frame : frames) {
            total += std::accumulate(frame.counts.begin(), frame.counts.end(), 0.0);
        }
        return total / static_cast<double>(frames.size());
    };
    const double pixels = static_cast<double>(dark.frames.front().counts.size());
    return (sum(point.frames) - sum(dark.frames)) / pixels;
}

// One angle of incidence reduced as it stands, near the middle of its wavelengths.
std::string angle_summary(const Journal& journal, uint32_t block) {
    Journal one;
    one.header = journal.header;
    one.plan = journal.plan;
    one.exposures = journal.exposures;
    one.resumes = journal.resumes;
    for (const JournalDark& dark : journal.darks) {
        if (dark.block == block) one.darks.push_back(dark);
    }
    for (const JournalPoint& point : journal.points) {
        if (journal.plan[point.index].block == block) one.points.push_back(point);
    }
    std::vector<std::string> ignored;
    const NoiseModel noise = fit_noise_model(one);
    const Recipe& recipe = journal.header->recipe;
    ReductionOptions options;
    const double middle = (recipe.first_nm + recipe.last_nm) / 2;
    options.first_nm = options.last_nm = middle;
    options.step_nm = std::max(recipe.step_nm, 10.0);
    options.harmonic_4 = recipe.harmonic_4;
    options.drift = recipe.drift;
    const Reduction reduction =
        reduce_scans(scans_of(one, noise, &ignored), journal.header->spectrometer, {}, options);
    const MeasurementRow& row = reduction.rows.front();
    return fmt::format("{} degrees: Psi {:.2f}, Delta {:.2f} at {} nm (not calibrated)",
                       row.angle_deg, row.psi_deg, row.delta_deg, row.wavelength_nm);
}

}  // namespace

std::string text_plot(const std::vector<double>& x, const std::vector<double>& y,
                      const std::string& title, size_t width, size_t height) {
    const auto [first, last] = std::minmax_element(x.begin(), x.end());
    const double span = std::max(*last - *first, 1e-12);
    const double top = std::max(*std::max_element(y.begin(), y.end()), 1e-12);
    std::vector<std::string> rows(height, std::string(width, ' '));
    for (size_t i = 0; i < x.size(); ++i) {
        const double across = (x[i] - *first) / span * static_cast<double>(width - 1);
        const double up = std::clamp(y[i] / top, 0.0, 1.0) * static_cast<double>(height - 1);
        rows[height - 1 - static_cast<size_t>(std::lround(up))]
            [static_cast<size_t>(std::lround(across))] = '*';
    }
    std::string text = title + "\n";
    for (size_t i = 0; i < height; ++i) {
        const std::string label = i == 0 ? fmt::format("{:>8.0f}", top) : std::string(8, ' ');
        text += fmt::format("{} |{}\n", i + 1 == height ? "       0" : label, rows[i]);
    }
    return text;
}

std::string fitted(const std::string& text, size_t columns, size_t lines, size_t fixed) {
    std::vector<std::string> kept;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) kept.push_back(line.substr(0, columns));
    const size_t excess = kept.size() > lines ? kept.size() - lines : 0;
    const size_t first = std::min(fixed, kept.size());
    const size_t dropped = std::min(excess, kept.size() - first);
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(first),
               kept.begin() + static_cast<std::ptrdiff_t>(first + dropped));
    std::string result;
    for (const std::string& line : kept) result += line + "\n";
    return result;
}

LivePlot::LivePlot(bool quiet) : draws_(!quiet && can_redraw_stderr()) {}

void LivePlot::draw(const Journal& so_far) {
    if (!draws_ || so_far.points.empty()) return;
    const PlanPoint& last = so_far.plan[so_far.points.back().index];
    const JournalDark* dark = so_far.dark(last.block);
    if (dark == nullptr) return;
    std::vector<double> azimuths, light;
    for (const JournalPoint& point : so_far.points) {
        const PlanPoint& plan = so_far.plan[point.index];
        if (plan.scan != last.scan) continue;
        azimuths.push_back(point.polariser_deg);
        light.push_back(mean_light(point, *dark));
    }
    const bool block_ends = so_far.points.back().index + 1 == so_far.plan.size() ||
                            so_far.plan[so_far.points.back().index + 1].block != last.block;
    if (block_ends && so_far.header->recipe.kind == RecipeKind::psi_delta) {
        try {
            finished_.push_back(angle_summary(so_far, last.block));
        } catch (const Error&) {
            // The picture is for the eye; what cannot be reduced is said at the end.
        }
    }
    std::string text = text_plot(
        azimuths, light,
        fmt::format("{}, analyser {} degrees{}: mean counts against the polariser, degrees",
                    last.straight_through ? std::string("straight through")
                                          : fmt::format("{} degrees", last.incidence_deg),
                    last.analyser_deg, last.retarder_in ? ", with retarder" : ""),
        plot_width, plot_height);
    for (const std::string& line : finished_) text += line + "\n";
    // A line that the terminal breaks in two would shift every picture after it. The last line is
    // the progress bar's.
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
        size.ws_col = 80;
        size.ws_row = 24;
    }
    if (size.ws_row < plot_height + 2) return;
    text = fitted(text, size.ws_col, size.ws_row - 1U, plot_height + 1);
    std::string screen = "\r\033[K";
    if (lines_ > 0) screen += fmt::format("\033[{}A", lines_);
    for (const char c : text) {
        if (c == '\n') screen += "\033[K";
        screen += c;
    }
    lines_ = static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
    std::fputs(screen.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace drude
