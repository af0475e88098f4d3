#include "fitter/profile_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drude {

namespace {

constexpr double open_end = std::numeric_limits<double>::quiet_NaN();

struct Bracket {
    double inside, outside;      // distance from the best value
    double f_inside, f_outside;  // root of the rise, less that which is sought
};

// The square root of the rise is a straight line for a parabola, so that the secant lands at once.
class Side {
  public:
    Side(const HeldChi2& held, double value, double smallest, double direction, double reach)
        : held_(held), value_(value), smallest_(smallest), direction_(direction), reach_(reach) {}

    // The distance at which chi-square has risen by `rise`, NaN where it does not within reach.
    double distance(double rise, double guess) {
        const double wanted = std::sqrt(rise);
        Bracket bracket{0, std::min(guess, reach_), -wanted, 0};
        for (;;) {
            bracket.f_outside = root_of_rise(bracket.outside) - wanted;
            if (bracket.f_outside >= 0) break;
            if (bracket.outside >= reach_) return open_end;
            bracket.inside = bracket.outside;
            bracket.f_inside = bracket.f_outside;
            bracket.outside = std::min(2 * bracket.outside, reach_);
        }
        return root(bracket, wanted);
    }

    double deepest() const { return deepest_; }

  private:
    double root_of_rise(double distance) {
        const double chi2 = held_(value_ + direction_ * distance);
        // Nothing reflected, or no convergence: as good as far away.
        if (!std::isfinite(chi2)) return 1e6;
        deepest_ = std::max(deepest_, smallest_ - chi2);
        return std::sqrt(std::max(0.0, chi2 - smallest_));
    }

    // False position with every third step a bisection, so that it cannot crawl.
    double root(Bracket b, double wanted) {
        for (int i = 0; i < 60 && b.outside - b.inside > 1e-5 * b.outside; ++i) {
            const bool bisect = i % 3 == 2 || b.f_outside > 10;
            const double share = bisect ? 0.5 : b.f_inside / (b.f_inside - b.f_outside);
            const double middle = b.inside + std::clamp(share, 0.01, 0.99) * (b.outside - b.inside);
            const double f = root_of_rise(middle) - wanted;
            if (std::abs(f) < 1e-6) return middle;
            (f > 0 ? b.outside : b.inside) = middle;
            (f > 0 ? b.f_outside : b.f_inside) = f;
        }
        return 0.5 * (b.inside + b.outside);
    }

    const HeldChi2& held_;
    double value_, smallest_, direction_, reach_;
    double deepest_ = 0;
};

}  // namespace

Profile profile_of(const HeldChi2& held, double value, double smallest, double sigma, double lower,
                   double upper) {
    const double range = upper - lower;
    double guess = std::isfinite(sigma) && sigma > 0 ? sigma : 1e-3 * range;
    guess = std::clamp(guess, 1e-9 * range, range);
    Profile profile;
    for (const double direction : {-1.0, 1.0}) {
        const double reach = direction < 0 ? value - lower : upper - value;
        Side side(held, value, smallest, direction, reach);
        double from = guess;
        for (size_t i = 0; i < profile_rises.size(); ++i) {
            const double distance = reach > 0 ? side.distance(profile_rises[i], from) : open_end;
            double& end = direction < 0 ? profile.intervals[i].lower : profile.intervals[i].upper;
            end = value + direction * distance;
            if (std::isnan(distance)) {
                for (size_t j = i; j < profile_rises.size(); ++j) {
                    (direction < 0 ? profile.intervals[j].lower : profile.intervals[j].upper) =
                        open_end;
                }
                break;
            }
            from = 2 * distance;
        }
        profile.deepest = std::max(profile.deepest, side.deepest());
    }
    return profile;
}

LineMinimum minimise_on_line(const std::function<double(double)>& function, double low, double high,
                             double tolerance) {
    constexpr double golden = 0.3819660112501051;  // (3 - sqrt 5)/2
    // x: the best so far; w and v: the next best ones; step and the one before it.
    double x = low + golden * (high - low), w = x, v = x;
    double fx = function(x), fw = fx, fv = fx, step = 0, before = 0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        if (std::abs(x - middle) + 0.5 * (high - low) <= 2 * tolerance) break;
        const double r = (x - w) * (fx - fv), q = (x - v) * (fx - fw);
        double p = (x - v) * q - (x - w) * r, divisor = 2 * (q - r);
        if (divisor > 0) p = -p;
        divisor = std::abs(divisor);
        const bool parabola = std::abs(before) > tolerance &&
                              std::abs(p) < std::abs(0.5 * divisor * before) &&
                              p > divisor * (low - x) && p < divisor * (high - x);
        before = step;
        if (parabola) {
            step = p / divisor;
        } else {
            before = x < middle ? high - x : low - x;
            step = golden * before;
        }
        const double u = x + (std::abs(step) >= tolerance ? step : std::copysign(tolerance, step));
        const double fu = function(u);
        if (fu <= fx) {
            (u < x ? high : low) = x;
            v = w, fv = fw;
            w = x, fw = fx;
            x = u, fx = fu;
        } else {
            (u < x ? low : high) = u;
            if (fu <= fw || w == x) {
                v = w, fv = fw;
                w = u, fw = fu;
            } else if (fu <= fv || v == x || v == w) {
                v = u, fv = fu;
            }
        }
    }
    return {x, fx};
}

}  // namespace drude
