// A study's folder: study.json says what is in it; measurements, fits and pictures are files of
// their own, so that a page can be made from the folder alone.
#pragma once

#include <string>

#include "image/image.h"
#include "report/study_data.h"

namespace drude {

// DIR/study.json (format "drude-study/2"): what the files beside it do not say themselves.
std::string format_study_record(const Study& study);

// Reads DIR/study.json and every measurement and material it names; what can be computed from
// these (curves, distances from the literature) is. `pair` stays empty: read_pair() has the
// pictures. Throws Error (user) with file:line:column for a folder that holds no study, and for
// whatever is missing or wrong in it.
Study read_study(const std::string& folder);

// Of the half-spheres: with the roughness that the study's options give, or with the lobe and beta
// that the sample's lobe scan says.
enum class Finish { smooth, rough };

// The two renderings of one metal with one finish, with S0.R ... S3.B; and their spectral layers,
// which are the same pictures' where these have them, otherwise those of the smaller pictures
// fitted-spectral.exr and literature-spectral.exr (of the rough ones fitted-rough.exr,
// fitted-rough-spectral.exr, ...). Empty (0 x 0) where there are neither.
struct StudyPair {
    Image fitted, literature;
    Image fitted_spectral, literature_spectral;
    bool spectral_is_smaller = false;
};
// Throws Error (user) where a picture is missing, lacks its Stokes channels, or the two of a pair
// differ in size.
StudyPair read_pair(const std::string& folder, const StudyMetal& metal, Finish finish);

// "fitted.exr", "literature-rough-spectral.exr": a picture within its metal's folder.
std::string picture_file(bool fitted, Finish finish, bool spectral);

// rms_dn and rms_dk of `metal` against its literature's constants.
void compare_constants(StudyMetal* metal);

}  // namespace drude
