// Choosing from a discrete distribution by one uniform number, in the order of its entries, so that
// well-distributed numbers stay well distributed (an alias table would tear them apart).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace drude {

// Rows of cumulative sums, all of one length. A guide (Chen & Asau 1974) says where in a row to
// begin: the first entry above every fraction k / guides of the total, from where a few steps are
// left.
class CumulativeRows {
  public:
    CumulativeRows() = default;
    // `sums`: rows * length cumulative sums, ascending within a row, from weights of 0 or more.
    CumulativeRows(std::vector<float> sums, size_t length)
        : length_(length), guides_(std::max<size_t>(1, length / 4)), sums_(std::move(sums)) {
        const size_t rows = sums_.size() / length_;
        guide_.resize(rows * guides_);
        for (size_t row = 0; row < rows; ++row) {
            const float* sum = &sums_[row * length_];
            uint32_t i = 0;
            for (size_t k = 0; k < guides_; ++k) {
                const float fraction = static_cast<float>(k) / static_cast<float>(guides_);
                while (i + 1 < length_ && sum[i] <= fraction * sum[length_ - 1]) ++i;
                guide_[row * guides_ + k] = i;
            }
        }
    }

    // The entry i with sum[i-1] <= u * total < sum[i], u in [0, 1), and where between.
    size_t find(size_t row, float u, float* inside) const {
        const float* sum = &sums_[row * length_];
        const float target = u * sum[length_ - 1];
        const size_t k =
            std::min(static_cast<size_t>(u * static_cast<float>(guides_)), guides_ - 1);
        size_t i = guide_[row * guides_ + k];
        while (i + 1 < length_ && sum[i] <= target) ++i;
        // Rounding of k may have begun too late, and the end may be an entry of no width.
        while (i > 0 && (sum[i - 1] > target || sum[i] == sum[i - 1])) --i;
        const float low = i > 0 ? sum[i - 1] : 0;
        *inside = std::clamp((target - low) / (sum[i] - low), 0.0f, 0x1.fffffep-1f);
        return i;
    }

  private:
    size_t length_ = 0, guides_ = 0;
    std::vector<float> sums_;
    std::vector<uint32_t> guide_;
};

}  // namespace drude
