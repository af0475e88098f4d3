#include "report/figure_9.h"

#include <algorithm>

#include "image/difference.h"
#include "image/tonemap.h"

namespace drude {

PairPictures pair_pictures(const StudyPair& pair, int threads) {
    const int width = pair.fitted.width, height = pair.fitted.height;
    const ColourBar bar = log_difference_bar();
    PairPictures pictures;
    pictures.difference = map_values(
        width, height, log_difference(pair.fitted, pair.literature, {"R", "G", "B"}), bar);
    DurandOptions durand;
    durand.threads = threads;
    const std::vector<float> fitted = rgb_values(pair.fitted, "the fitted picture");
    const std::vector<float> literature = rgb_values(pair.literature, "the literature's picture");
    // One compression, that of the fitted picture, for both: another for each would make up
    // differences.
    const DurandParameters parameters = durand_parameters(width, height, fitted, durand);
    pictures.fitted.width = pictures.literature.width = width;
    pictures.fitted.height = pictures.literature.height = height;
    pictures.fitted.rgb = tonemap_durand(width, height, fitted, parameters, durand);
    pictures.literature.rgb = tonemap_durand(width, height, literature, parameters, durand);
    return pictures;
}

FigureSheet::FigureSheet(const std::string& credit) {
    sheet_.title = credit;
    sheet_.row_captions = {"fitted", "literature", "log10 difference"};
    sheet_.cells.resize(3);
    sheet_.bars[2] = log_difference_bar();
}

void FigureSheet::add(const std::string& metal, const PairPictures& pictures) {
    sheet_.column_captions.push_back(metal);
    sheet_.cells[0].push_back(pictures.fitted);
    sheet_.cells[1].push_back(pictures.literature);
    sheet_.cells[2].push_back(pictures.difference);
}

Picture reduced(const Picture& picture, int factor) {
    if (factor <= 1) return picture;
    Picture small((picture.width + factor - 1) / factor, (picture.height + factor - 1) / factor,
                  {});
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            Colour sum = {};
            float count = 0;
            for (int v = y * factor; v < std::min(picture.height, (y + 1) * factor); ++v) {
                for (int u = x * factor; u < std::min(picture.width, (x + 1) * factor); ++u) {
                    const Colour c = picture.at(u, v);
                    for (size_t i = 0; i < 3; ++i) sum[i] += std::clamp(c[i], 0.0F, 1.0F);
                    count += 1;
                }
            }
            for (float& value : sum) value /= count;
            small.set(x, y, sum);
        }
    }
    return small;
}

std::string png(const Picture& picture) {
    return encode_png(picture.width, picture.height, picture.rgb);
}

}  // namespace drude
