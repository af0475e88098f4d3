// Choosing from a discrete distribution by one uniform number, in the order of its entries, so that
// well-distributed numbers stay well distributed (an alias table would tear them apart).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace drude {

// Rows of cumulative sums, all of one length. What such a table of millions of entries costs is its
// cache misses; so every 32nd sum stands apart once more, which makes two of them of a search.
class CumulativeRows {
  public:
    CumulativeRows() = default;
    // `sums`: rows * length cumulative sums, ascending within a row, from weights of 0 or more.
    CumulativeRows(std::vector<float> sums, size_t length)
        : length_(length), blocks_((length + block - 1) / block), sums_(std::move(sums)) {
        for (size_t row = 0; row * length_ < sums_.size(); ++row) {
            for (size_t b = 1; b <= blocks_; ++b) {
                coarse_.push_back(sums_[row * length_ + std::min(b * block, length_) - 1]);
            }
        }
    }

    // The entry i with sum[i-1] <= u * total < sum[i], u in [0, 1), and where between.
    size_t find(size_t row, float u, float* inside) const {
        const float* sum = &sums_[row * length_];
        const float* ends = &coarse_[row * blocks_];
        const float target = u * ends[blocks_ - 1];
        const size_t b =
            std::min<size_t>(std::upper_bound(ends, ends + blocks_, target) - ends, blocks_ - 1);
        const float* first = sum + b * block;
        const float* last = sum + std::min((b + 1) * block, length_);
        size_t i = std::min<size_t>(std::upper_bound(first, last, target) - sum, length_ - 1);
        // Rounding may land on an entry of no width at the end; step back to one that has some.
        while (i > 0 && sum[i] == sum[i - 1]) --i;
        const float low = i > 0 ? sum[i - 1] : 0;
        *inside = std::clamp((target - low) / (sum[i] - low), 0.0f, 0x1.fffffep-1f);
        return i;
    }

  private:
    static constexpr size_t block = 32;
    size_t length_ = 0, blocks_ = 0;
    std::vector<float> sums_, coarse_;
};

}  // namespace drude
