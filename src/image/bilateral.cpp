#include "image/bilateral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "base/executor.h"

namespace drude {

namespace {

void check(int width, int height, const std::vector<float>& values, const BilateralWidths& widths) {
    if (width < 1 || height < 1 ||
        values.size() != static_cast<size_t>(width) * static_cast<size_t>(height)) {
        throw std::logic_error("bilateral filter: a picture of a wrong size");
    }
    if (!(widths.space > 0.0) || !(widths.range > 0.0)) {
        throw std::logic_error("bilateral filter: widths must be above 0");
    }
    for (const float value : values) {
        if (!std::isfinite(value))
            throw std::logic_error("bilateral filter: a value is not finite");
    }
}

// Weighted values and weights, blurred together and divided at the end.
struct Node {
    float value = 0.0F, weight = 0.0F;
};

struct Grid {
    size_t nx, ny, nz;
    std::vector<Node> nodes;

    size_t index(size_t x, size_t y, size_t z) const { return (z * ny + y) * nx + x; }
};

// Where a coordinate falls: the node below and the distance from it.
struct Cell {
    size_t node;
    float distance;
};

Cell cell(double coordinate) {
    const double below = std::floor(coordinate);
    return {static_cast<size_t>(below), static_cast<float>(coordinate - below)};
}

std::vector<float> blur_kernel(double sigma) {
    const int radius = static_cast<int>(std::ceil(4.0 * sigma));
    std::vector<float> kernel;
    for (int i = -radius; i <= radius; ++i) {
        kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    }
    return kernel;
}

// Blurs one line of `count` nodes that lie `stride` apart.
void blur_line(Node* line, size_t count, size_t stride, const std::vector<float>& kernel,
               std::vector<Node>& scratch) {
    scratch.assign(count, Node{});
    const std::ptrdiff_t radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
    const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(count) - 1;
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        Node sum;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - radius);
             k <= std::min(last, i + radius); ++k) {
            const Node& node = line[static_cast<size_t>(k) * stride];
            const float weight = kernel[static_cast<size_t>(k - i + radius)];
            sum.value += weight * node.value;
            sum.weight += weight * node.weight;
        }
        scratch[static_cast<size_t>(i)] = sum;
    }
    for (size_t i = 0; i < count; ++i) line[i * stride] = scratch[i];
}

void blur(Grid& grid, const std::vector<float>& space, const std::vector<float>& range,
          int threads) {
    parallel_for(grid.nz, threads, [&](size_t z) {
        std::vector<Node> scratch;
        for (size_t y = 0; y < grid.ny; ++y) {
            blur_line(&grid.nodes[grid.index(0, y, z)], grid.nx, 1, space, scratch);
        }
        for (size_t x = 0; x < grid.nx; ++x) {
            blur_line(&grid.nodes[grid.index(x, 0, z)], grid.ny, grid.nx, space, scratch);
        }
    });
    parallel_for(grid.ny, threads, [&](size_t y) {
        std::vector<Node> scratch;
        for (size_t x = 0; x < grid.nx; ++x) {
            blur_line(&grid.nodes[grid.index(x, y, 0)], grid.nz, grid.nx * grid.ny, range, scratch);
        }
    });
}

// Calls visit(node, weight) for the eight nodes around a point.
template <class Visit>
void visit_corners(const Grid& grid, const Cell& x, const Cell& y, const Cell& z, Visit visit) {
    for (size_t corner = 0; corner < 8; ++corner) {
        const size_t dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const float weight = (dx ? x.distance : 1.0F - x.distance) *
                             (dy ? y.distance : 1.0F - y.distance) *
                             (dz ? z.distance : 1.0F - z.distance);
        visit(grid.index(x.node + dx, y.node + dy, z.node + dz), weight);
    }
}

}  // namespace

std::vector<float> bilateral_exact(int width, int height, const std::vector<float>& values,
                                   const BilateralWidths& widths, int threads) {
    check(width, height, values, widths);
    const int radius = static_cast<int>(std::ceil(4.0 * widths.space));
    const double per_space = -0.5 / (widths.space * widths.space);
    const double per_range = -0.5 / (widths.range * widths.range);
    std::vector<float> result(values.size());
    parallel_for(static_cast<size_t>(height), threads, [&](size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const double here = static_cast<double>(
                values[row * static_cast<size_t>(width) + static_cast<size_t>(x)]);
            double sum = 0.0, weights = 0.0;
            for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v) {
                for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u) {
                    const double there = static_cast<double>(
                        values[static_cast<size_t>(v) * static_cast<size_t>(width) +
                               static_cast<size_t>(u)]);
                    const double distance = (u - x) * (u - x) + (v - y) * (v - y);
                    const double step = there - here;
                    const double weight = std::exp(distance * per_space + step * step * per_range);
                    sum += weight * there;
                    weights += weight;
                }
            }
            result[row * static_cast<size_t>(width) + static_cast<size_t>(x)] =
                static_cast<float>(sum / weights);
        }
    });
    return result;
}

std::vector<float> bilateral_grid(int width, int height, const std::vector<float>& values,
                                  const BilateralWidths& widths, int threads) {
    check(width, height, values, widths);
    const double nodes_a_space = 3.0, nodes_a_range = 2.0;
    // A node spacing below a pixel would cost memory and gain nothing.
    const double per_pixel = std::min(1.0, nodes_a_space / widths.space);
    const auto range = std::minmax_element(values.begin(), values.end());
    const double lowest = static_cast<double>(*range.first);
    // Values far apart for their width do not see each other; a grid of 4096 levels is enough to
    // keep them apart and bounds the memory.
    const double span = static_cast<double>(*range.second) - lowest;
    const double per_value = std::min(nodes_a_range / widths.range, 4096.0 / std::max(span, 1e-30));
    Grid grid;
    grid.nx = static_cast<size_t>(std::floor((width - 1) * per_pixel)) + 2;
    grid.ny = static_cast<size_t>(std::floor((height - 1) * per_pixel)) + 2;
    grid.nz = static_cast<size_t>(std::floor(span * per_value)) + 2;
    grid.nodes.resize(grid.nx * grid.ny * grid.nz);

    const auto row_of = [&](size_t y) { return cell(static_cast<double>(y) * per_pixel); };
    const auto level_of = [&](float value) {
        return cell((static_cast<double>(value) - lowest) * per_value);
    };
    const size_t columns = static_cast<size_t>(width), rows = static_cast<size_t>(height);
    for (size_t y = 0; y < rows; ++y) {
        for (size_t x = 0; x < columns; ++x) {
            const float value = values[y * columns + x];
            visit_corners(grid, row_of(x), row_of(y), level_of(value),
                          [&](size_t node, float weight) {
                              // Relative to the lowest value, so that nothing is lost to a large
                              // offset.
                              grid.nodes[node].value += weight * (value - *range.first);
                              grid.nodes[node].weight += weight;
                          });
        }
    }
    // Linear splatting and slicing are two tents, each of variance 1/6 node spacings squared.
    constexpr double tents = 1.0 / 3.0;
    const double sigma_space = widths.space * per_pixel, sigma_range = widths.range * per_value;
    const auto narrowed = [](double sigma) {
        return std::sqrt(std::max(sigma * sigma - tents, 0.05));
    };
    blur(grid, blur_kernel(narrowed(sigma_space)), blur_kernel(narrowed(sigma_range)), threads);

    std::vector<float> result(values.size());
    parallel_for(rows, threads, [&](size_t y) {
        for (size_t x = 0; x < columns; ++x) {
            const float value = values[y * columns + x];
            Node sum;
            visit_corners(grid, row_of(x), row_of(y), level_of(value),
                          [&](size_t node, float weight) {
                              sum.value += weight * grid.nodes[node].value;
                              sum.weight += weight * grid.nodes[node].weight;
                          });
            // The pixel's own splat is under the blur's centre: the weight is never zero.
            result[y * columns + x] = sum.value / sum.weight + *range.first;
        }
    });
    return result;
}

}  // namespace drude
