// The numbers of a study's pictures, as the JSON that its page carries for the reader to look into:
// tone mapping, differences and the read-out at the cursor are made from it in the browser.
//
// All pictures of a study show one scene with one seed, so what lies beside the metal is equal to
// the bit in all of them: those pixels are embedded once, each picture brings its own of the rest.
// Values are an EXR's own, rounded to half floats and never averaged; where a layer would be too
// large it keeps every second (third, ...) pixel of every second row: S0 of the blurred pictures
// before anything of the sharp ones.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "report/study_folder.h"

namespace drude {

// Upper bounds of what each kind of layer may weigh before it is deflated.
struct PictureBudget {
    int side = 512;                 // pixels shown along the longer side
    size_t stokes_bytes = 3500000;  // S1..S3 of R, G, B
    size_t spectral_bytes = 4000000;
    size_t colour_bytes = 8500000;  // S0 of R, G, B; sharp pictures are never thinned out
};

class PictureData {
  public:
    explicit PictureData(const PictureBudget& budget = {});

    // In the page's order; `id` (of identifier()) is that of its figure there. Throws Error (user)
    // where the size, or the spectral layers, differ from those of the pairs before it.
    void add(const std::string& id, const StudyPair& pair, bool blurred = false);

    // The JSON document; "" where nothing was added. ASCII, without '<', so that it may stand
    // within a script element.
    std::string json() const;
    // What is embedded, for people.
    std::string description() const;

  private:
    // Half floats of one picture's layers on a grid of pixels: values[row][plane * pixels + p], a
    // row being a Stokes component, a plane R, G, B or a wavelength.
    struct Layers {
        std::array<std::vector<uint16_t>, 4> values;
    };
    struct Grid {
        int width = 0, height = 0;
        size_t planes = 0;
        std::vector<Layers> pictures;
        std::vector<char> blurred;  // 1: of such a pair; one for each picture
        std::vector<char> own;      // 1 where the pictures differ

        size_t pixels() const { return static_cast<size_t>(width) * height; }
        void add(Layers layers, bool is_blurred);
        // Pixels of the shared (own = 0) or the own kind, in reading order, every step-th only.
        std::vector<size_t> chosen(char kind, int step) const;
        size_t bytes(int step, int first_row) const;
        // The least step, a multiple of `unit`, at which rows from `first_row` fit.
        int fitting_step(size_t budget, int first_row, int unit) const;
        // The least step of the blurred pictures' S0 at which that of all fits, the others' whole.
        int blurred_step(size_t budget) const;
        // `first` is the step of S0, `rest` that of the others.
        std::string packed(size_t picture, char kind, int first, int rest) const;
    };
    static Layers layers_of(const Image& image, const std::vector<std::array<size_t, 4>>& planes,
                            int step);
    void add_spectra(const StudyPair& pair);

    PictureBudget budget_;
    int step_ = 1;  // pixels of the EXR between two shown ones
    int exr_width_ = 0, exr_height_ = 0;
    Grid colour_, spectral_;
    int spectral_step_ = 1;  // pixels of the EXR between two of the spectral grid
    bool spectral_is_smaller_ = false;
    std::vector<double> wavelengths_;  // of the spectral layers, nm
    std::string ids_;                  // of the pairs, quoted, with commas between
};

}  // namespace drude
