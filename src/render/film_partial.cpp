#include "render/film_partial.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/crc32.h"
#include "base/error.h"
#include "base/numbers.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

constexpr const char* format_name = "drude-sums/1";

std::string channel_name(size_t word) {
    return fmt::format("sums.{:03}", word);
}

std::string_view bytes_of(const uint32_t* words, size_t count) {
    return {reinterpret_cast<const char*>(words), count * sizeof(uint32_t)};
}

// Everything that a reader relies on, as one text.
std::string relied_on(const FilmPart& part) {
    std::string text;
    for (const auto& [name, value] : part.job.fields())
        text.append(name).append("=").append(value).append("\n");
    const FilmCounts& c = part.counts;
    return text + fmt::format("{} {} {} {} {} {} {} {} {}", part.batches, part.first, part.last,
                              part.fewest, c.rays, c.projections, c.not_finite, c.out_of_range,
                              format_double(c.seconds));
}

// Attributes of a file of sums, read strictly.
class Fields {
  public:
    Fields(const std::string& path, const std::map<std::string, Attribute>& attributes)
        : path_(path), attributes_(attributes) {}

    std::string text(const char* name) const {
        const auto found = attributes_.find(name);
        const auto* value =
            found == attributes_.end() ? nullptr : std::get_if<std::string>(&found->second);
        if (!value) bad(name);
        return *value;
    }
    int whole(const char* name, int least) const {
        const auto found = attributes_.find(name);
        const auto* value = found == attributes_.end() ? nullptr : std::get_if<int>(&found->second);
        if (!value || *value < least) bad(name);
        return *value;
    }
    uint64_t count(const char* name) const {
        const std::optional<uint64_t> value = parse_unsigned(text(name));
        if (!value) bad(name);
        return *value;
    }
    [[noreturn]] void bad(const char* name) const {
        user_error("{}: damaged file of sums: attribute '{}' is missing or makes no sense", path_,
                   name);
    }

  private:
    const std::string& path_;
    const std::map<std::string, Attribute>& attributes_;
};

FilmPart read_part(const ExrPicture& picture, const std::string& path) {
    const Fields fields(path, picture.attributes);
    const auto found = picture.attributes.find("drudeSums");
    if (found == picture.attributes.end()) {
        user_error(
            "{}: is no file of sums; expected one that 'drude render --shard' or an interrupted "
            "render wrote",
            path);
    }
    if (fields.text("drudeSums") != format_name) {
        user_error("{}: holds sums of the format '{}'; expected '{}'", path,
                   fields.text("drudeSums"), format_name);
    }
    FilmPart part;
    FilmJob& job = part.job;
    job.scene_hash = fields.text("sceneHash");
    job.width = picture.width;
    job.height = picture.height;
    job.seed = fields.count("seed");
    job.batch_size = fields.whole("batchSize", 1);
    job.max_depth = fields.whole("maxDepth", 0);
    job.wavelengths = fields.whole("wavelengths", 1);
    if (picture.attributes.count("analyser")) job.analyser = fields.text("analyser");
    if (picture.attributes.count("crop")) job.crop = fields.text("crop");
    job.spectral = fields.whole("spectral", 0) != 0;
    job.instruction_set = fields.text("instructionSet");
    job.version = fields.text("drudeVersion");
    const std::string transport = fields.text("transport");
    bool known = false;
    for (const Transport t : {Transport::scalar, Transport::intensity, Transport::stokes}) {
        if (transport_name(t) != transport) continue;
        job.transport = t;
        known = true;
    }
    if (!known) fields.bad("transport");
    part.batches = static_cast<uint32_t>(fields.whole("pictureBatches", 0));
    part.fewest = static_cast<uint32_t>(fields.whole("batches", 0));
    const std::string range = fields.text("batchRange");
    const size_t colon = std::min(range.find(':'), range.size());
    const auto first = parse_unsigned(range.substr(0, colon));
    const auto last = parse_unsigned(range.substr(std::min(colon + 1, range.size())));
    if (!first || !last || *first > *last || *last > most_terms) fields.bad("batchRange");
    part.first = static_cast<uint32_t>(*first);
    part.last = static_cast<uint32_t>(*last);
    part.counts.rays = fields.count("rays");
    part.counts.projections = fields.count("projections");
    part.counts.not_finite = fields.count("notFinite");
    part.counts.out_of_range = fields.count("outOfRange");
    const std::optional<double> seconds = parse_double(fields.text("renderSeconds"));
    if (!seconds || !(*seconds >= 0)) fields.bad("renderSeconds");
    part.counts.seconds = *seconds;
    return part;
}

}  // namespace

FilmWords::FilmWords(const FilmPart& part)
    : width_(static_cast<size_t>(part.job.width)),
      words_(part.job.layout().words()),
      batches_(part.last - part.first),
      fewest_(part.fewest),
      salt_(crc32(relied_on(part))) {}

void FilmWords::write_row(const FilmSums& sums, size_t first_pixel, uint32_t* words) const {
    std::vector<uint32_t> pixel(words_);
    for (size_t x = 0; x < width_; ++x) {
        sums.to_words(first_pixel + x, pixel.data());
        for (size_t i = 0; i < words_; ++i) words[i * width_ + x] = pixel[i];
        words[words_ * width_ + x] = crc32(bytes_of(pixel.data(), words_), salt_);
    }
}

bool FilmWords::read_row(const uint32_t* words, FilmSums* sums, size_t first_pixel) const {
    std::vector<uint32_t> pixel(words_);
    for (size_t x = 0; x < width_; ++x) {
        for (size_t i = 0; i < words_; ++i) pixel[i] = words[i * width_ + x];
        if (words[words_ * width_ + x] != crc32(bytes_of(pixel.data(), words_), salt_)) {
            return false;
        }
        if (pixel[0] > batches_ || pixel[0] < fewest_) return false;
        if (!sums->from_words(first_pixel + x, pixel.data())) return false;
    }
    return true;
}

void write_partial(const std::string& path, const FilmPart& part, const FilmSums& sums,
                   const std::string& command_line) {
    const FilmWords format(part);
    ExrPicture picture;
    picture.width = part.job.width;
    picture.height = part.job.height;
    for (size_t i = 0; i + 1 < format.channels(); ++i) {
        picture.channels.push_back({channel_name(i), ExrSamples::uint32});
    }
    picture.channels.push_back({"sums.check", ExrSamples::uint32});
    auto& a = picture.attributes;
    a = picture_attributes(part.job, part.first, part.fewest);
    a["drudeSums"] = std::string(format_name);
    a["maxDepth"] = part.job.max_depth;
    a["spectral"] = part.job.spectral ? 1 : 0;
    a["pictureBatches"] = static_cast<int>(part.batches);
    a["batchRange"] = fmt::format("{}:{}", part.first, part.last);
    a["rays"] = fmt::format("{}", part.counts.rays);
    a["projections"] = fmt::format("{}", part.counts.projections);
    a["notFinite"] = fmt::format("{}", part.counts.not_finite);
    a["outOfRange"] = fmt::format("{}", part.counts.out_of_range);
    a["renderSeconds"] = format_double(part.counts.seconds);
    a["commandLine"] = command_line;
    const auto width = static_cast<size_t>(picture.width);
    write_exr_rows(path, picture, Compression::none, [&](int y, uint32_t* words) {
        format.write_row(sums, static_cast<size_t>(y) * width, words);
    });
}

PartialReader::PartialReader(const std::string& path)
    : path_(path), reader_(path), part_(read_part(reader_.picture(), path)) {
    const FilmWords format(part_);
    const std::vector<ExrChannel>& channels = reader_.picture().channels;
    bool good = channels.size() == format.channels() && channels.back().name == "sums.check";
    for (size_t i = 0; good && i < channels.size(); ++i) {
        good = channels[i].samples == ExrSamples::uint32 &&
               (i + 1 == channels.size() || channels[i].name == channel_name(i));
    }
    if (!good)
        user_error("{}: damaged file of sums: its channels are not those it should have", path);
    // Before rows of a width are set aside that a damaged header made up.
    const uint64_t words = uint64_t{part_.job.layout().pixels()} * format.channels();
    std::error_code error;
    const uint64_t size = std::filesystem::file_size(path, error);
    if (!error && size / sizeof(uint32_t) < words) {
        user_error("{}: is cut short: {} bytes where its sums need {}; copy or render it again",
                   path, size, words * sizeof(uint32_t));
    }
    words_.resize(static_cast<size_t>(part_.job.width) * format.channels());
}

void PartialReader::read_row(int y, FilmSums* sums, size_t first_pixel) {
    reader_.read(y, words_.data());
    if (!FilmWords(part_).read_row(words_.data(), sums, first_pixel)) {
        user_error("{}: damaged file of sums: row {} does not match its check; render it again",
                   path_, y);
    }
}

}  // namespace drude
