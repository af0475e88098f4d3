#include "device/sweep/exposure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "device/device_error.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr double lowest_peak = 0.70, target_peak = 0.775, highest_peak = 0.85;
constexpr double first_try_s = 0.01;
constexpr double surely_unsaturated = 0.9;  // noise does not take a peak from here to full scale
constexpr int most_adjustments = 24;

bool same_arms(const PlanPoint& a, const PlanPoint& b) {
    return a.straight_through == b.straight_through && a.incidence_deg == b.incidence_deg &&
           a.offset_deg == b.offset_deg;
}

class ExposureSearch {
  public:
    ExposureSearch(BenchDriver& driver, const Bench& bench, const std::vector<PlanPoint>& points,
                   const ExposureLimits& limits)
        : driver_(driver),
          info_(bench.spectrometer->info()),
          name_(bench.name),
          by_hand_(bench.goniometer_by_hand),
          points_(points),
          max_(info_.max_counts),
          shortest_s_(info_.shortest_s),
          longest_s_(std::min(limits.longest_s, info_.longest_s)),
          least_signal_(limits.least_signal),
          integration_s_(std::clamp(first_try_s, shortest_s_, longest_s_)) {}

    ExposureChoice search() {
        driver_.set_lamp(true);
        choose_arms();
        if (steps_in_one_scan()) {
            choose_polariser();
        } else {
            choose_reading();
        }
        return adjust();
    }

  private:
    // Counts less the level of the dark pixels, which is what the lamp adds; the least of the
    // spectrum stands for the level.
    struct Reading {
        std::vector<double> net;
        double peak = 0;  // highest count over max_counts, dark included
        double level = 0;
    };

    Reading read(PlanPoint point) {
        driver_.set_integration_time(integration_s_);
        driver_.set(point);
        const Frame frame = driver_.acquire();
        check_saturation(frame);
        const auto [least, most] = std::minmax_element(frame.counts.begin(), frame.counts.end());
        Reading reading;
        reading.level = *least / max_;
        reading.peak = *most / max_;
        for (const uint32_t count : frame.counts)
            reading.net.push_back(count / max_ - reading.level);
        return reading;
    }

    double peak(const Frame& frame) const {
        return *std::max_element(frame.counts.begin(), frame.counts.end()) / max_;
    }

    // What reads full scale does so again, or the frame was not that of the light.
    void check_saturation(const Frame& frame) {
        if (peak(frame) < 1) return;
        const double again = peak(driver_.acquire());
        if (again >= surely_unsaturated) return;
        device_error(Fault::bad_frame,
                     "{}: a frame reads full scale and the next one of the same light {:.0f} % of "
                     "it; is the light steady?",
                     info_.uri, 100 * again);
    }

    // Like read(), at a time at which nothing is saturated and something is seen, if there is one.
    // A changed time makes what was read before incomparable: `changed` says so.
    Reading read_in_range(const PlanPoint& point, bool* changed) {
        for (int i = 0; i < most_adjustments; ++i) {
            Reading reading = read(point);
            if (reading.peak >= 1) {
                if (integration_s_ <= shortest_s_) too_bright();
                integration_s_ = std::max(shortest_s_, integration_s_ / 4);
            } else if (reading.peak - reading.level < least_signal_ &&
                       integration_s_ < longest_s_ && !seen_) {
                integration_s_ = std::min(longest_s_, integration_s_ * 4);
            } else {
                seen_ = seen_ || reading.peak - reading.level >= least_signal_;
                return reading;
            }
            *changed = true;
        }
        return read(point);
    }

    // Repeats `measure` until all of its readings were taken at one integration time.
    template <class Measure>
    void at_one_time(Measure measure) {
        for (int i = 0; i < most_adjustments; ++i) {
            bool changed = false;
            measure(&changed);
            if (!changed) return;
        }
    }

    // The sum over two crossed polarisers, of the brightest pixel.
    void choose_arms() {
        // Of a lobe the mirror direction, or what is measured nearest to it, is the brightest.
        std::map<double, double> nearest;
        for (const PlanPoint& point : points_) {
            const double distance = std::abs(point.offset_deg);
            const auto entry = nearest.emplace(point.incidence_deg, distance).first;
            entry->second = std::min(entry->second, distance);
        }
        std::vector<PlanPoint> arms;
        for (const PlanPoint& point : points_) {
            if (std::abs(point.offset_deg) > nearest[point.incidence_deg]) continue;
            if (arms.empty() || !same_arms(arms.back(), point)) arms.push_back(point);
        }
        brightest_ = arms.front();
        if (arms.size() < 2) return;
        if (by_hand_) {
            warnings_.push_back(
                "the integration time was chosen at the first angle only, since the arms are moved "
                "by hand: a brighter angle may read too high; --integration sets it");
            return;
        }
        at_one_time([&](bool* changed) {
            double best = -1;
            for (const PlanPoint& point : arms) {
                PlanPoint p = point, s = point;
                p.polariser_deg = 0;
                s.polariser_deg = 90;
                Reading sum = read_in_range(p, changed);
                if (*changed) return;
                const Reading other = read_in_range(s, changed);
                if (*changed) return;
                for (size_t i = 0; i < sum.net.size(); ++i) sum.net[i] += other.net[i];
                const double peak = *std::max_element(sum.net.begin(), sum.net.end());
                if (peak > best) {
                    best = peak;
                    brightest_ = point;
                }
            }
        });
    }

    // Of a lobe scan s and p only are read, in which the analyser may follow the polariser.
    bool steps_in_one_scan() const {
        const PlanPoint& first = points_.front();
        return std::count_if(points_.begin(), points_.end(), [&](const PlanPoint& point) {
                   return point.scan == first.scan && point.analyser_deg == first.analyser_deg;
               }) > 2;
    }

    // Where the fitted intensity of the brightest pixel is largest, over the settings of retarder
    // and analyser at the arms chosen.
    void choose_polariser() {
        std::vector<PlanPoint> scans;
        for (const PlanPoint& point : points_) {
            if (same_arms(point, brightest_) &&
                (scans.empty() || scans.back().scan != point.scan)) {
                scans.push_back(point);
            }
        }
        at_one_time([&](bool* changed) {
            double best = -1;
            for (PlanPoint setting : scans) {
                Reading readings[3];
                for (int i = 0; i < 3; ++i) {
                    setting.polariser_deg = 60.0 * i;
                    readings[i] = read_in_range(setting, changed);
                    if (*changed) return;
                }
                for (size_t pixel = 0; pixel < readings[0].net.size(); ++pixel) {
                    // Three azimuths 60 degrees apart are 120 apart in 2P: exact.
                    const double x = readings[0].net[pixel], y = readings[1].net[pixel],
                                 z = readings[2].net[pixel];
                    const double mean = (x + y + z) / 3;
                    const double a = (2 * x - y - z) / 3, b = (y - z) / std::sqrt(3.0);
                    const double peak = mean + std::hypot(a, b);
                    if (peak <= best) continue;
                    best = peak;
                    brightest_ = setting;
                    brightest_.polariser_deg = std::atan2(b, a) / 2 * 180 / pi;
                }
            }
        });
    }

    // Of the few settings of the polariser that are measured there.
    void choose_reading() {
        at_one_time([&](bool* changed) {
            double best = -1;
            for (const PlanPoint& point : points_) {
                if (!same_arms(point, brightest_)) continue;
                const Reading reading = read_in_range(point, changed);
                if (*changed) return;
                if (reading.peak <= best) continue;
                best = reading.peak;
                brightest_ = point;
            }
        });
    }

    ExposureChoice adjust() {
        Reading reading;
        for (int i = 0; i < most_adjustments; ++i) {
            reading = read(brightest_);
            if (reading.peak >= lowest_peak && reading.peak <= highest_peak) break;
            const double signal = reading.peak - reading.level;
            double next = integration_s_ / 4;
            if (reading.peak < 1) {
                // A signal of a few counts says nothing of how much more is needed.
                const double factor = (target_peak - reading.level) / std::max(signal, 1e-6);
                next = integration_s_ * std::clamp(factor, 0.25, 4.0);
            }
            if (reading.peak >= highest_peak && integration_s_ <= shortest_s_) too_bright();
            next = std::clamp(next, shortest_s_, longest_s_);
            if (next == integration_s_) break;
            integration_s_ = next;
        }
        if (reading.peak - reading.level < least_signal_) too_dark(reading);
        if (reading.peak < lowest_peak) {
            warnings_.push_back(fmt::format(
                "at the longest integration time used, {} s, the brightest setting reads {:.0f} % "
                "of the spectrometer's range (70 wanted): more averages lower the noise",
                integration_s_, 100 * reading.peak));
        }
        return {integration_s_, reading.peak, brightest_, warnings_};
    }

    [[noreturn]] void too_bright() const {
        outside_error(
            "{}: the brightest setting reads above {:.0f} % of the spectrometer's range at its "
            "shortest integration time, {} s; dim the light (a grey filter, a smaller stop), or "
            "set a time with --integration and have what is saturated left out",
            name_, 100 * highest_peak, shortest_s_);
    }

    [[noreturn]] void too_dark(const Reading& reading) const {
        outside_error(
            "{}: the brightest setting reads {:.2f} % of the spectrometer's range above its "
            "darkest pixel at {} s; is the lamp on, its shutter open, the sample and the detector "
            "in the beam?",
            name_, 100 * (reading.peak - reading.level), integration_s_);
    }

    BenchDriver& driver_;
    const SpectrometerInfo& info_;
    const std::string& name_;
    bool by_hand_;
    const std::vector<PlanPoint>& points_;
    double max_, shortest_s_, longest_s_;
    double least_signal_;  // of max_counts, below which nothing is modelled
    double integration_s_;
    bool seen_ = false;
    PlanPoint brightest_;
    std::vector<std::string> warnings_;
};

}  // namespace

ExposureLimits exposure_limits(const Recipe& recipe) {
    ExposureLimits limits;
    if (recipe.kind == RecipeKind::lobe) {
        limits.longest_s = recipe.longest_integration_s;
        limits.least_signal = 0.002;
    }
    return limits;
}

ExposureChoice choose_exposure(BenchDriver& driver, const Bench& bench,
                               const std::vector<PlanPoint>& points, const ExposureLimits& limits) {
    return ExposureSearch(driver, bench, points, limits).search();
}

}  // namespace drude
