#include "render/film_schedule.h"

#include <algorithm>
#include <cmath>

namespace drude {

namespace {

constexpr uint32_t first_look = 4;

}  // namespace

uint32_t FilmSchedule::next_look(uint32_t done) {
    uint32_t look = first_look;
    while (look <= done) look += std::max(1u, look / 8);
    return look;
}

bool FilmSchedule::is_look(uint32_t done) {
    return done >= first_look && next_look(done - 1) == done;
}

uint32_t FilmSchedule::next(uint32_t done, double seconds) const {
    if (done >= rule_.most) return done;
    if (!rule_.seconds && !rule_.error) {
        // A whole picture early, then quarters: an interrupt leaves a picture of about as many
        // samples everywhere.
        if (done == 0) return 1;
        for (uint64_t quarter = 1; quarter < 4; ++quarter) {
            const auto target = static_cast<uint32_t>(rule_.most * quarter / 4);
            if (target > done) return target;
        }
        return rule_.most;
    }
    uint32_t target = rule_.most;
    if (rule_.error) target = std::min(target, next_look(done));
    if (rule_.seconds) {
        if (done == 0) return 1;
        const double fit = (*rule_.seconds - seconds) * done / std::max(seconds, 1e-9);
        if (!(fit >= 1)) return done;
        // Doubling at most, since the time of the first batches is a poor guess.
        const double step = std::min(fit, static_cast<double>(done));
        target = std::min(target, done + static_cast<uint32_t>(step));
    }
    return target;
}

double relative_error(const FilmSums& sums) {
    const size_t pixels = sums.layout().pixels();
    const auto square = [&](size_t p) {
        double total = 0;
        for (int c = 0; c < 3; ++c) {
            const double value = sums.mean(p, 0, c);
            total += value * value;
        }
        return total;
    };
    double level = 0;
    for (size_t p = 0; p < pixels; ++p) level += std::sqrt(square(p));
    level *= 0.1 / static_cast<double>(pixels);
    if (!(level > 0)) return 0;
    double total = 0;
    for (size_t p = 0; p < pixels; ++p) {
        double variance = 0;
        for (int c = 0; c < 3; ++c) variance += sums.variance(p, 0, c);
        total += variance / (square(p) + level * level);
    }
    return std::sqrt(total / static_cast<double>(pixels));
}

}  // namespace drude
