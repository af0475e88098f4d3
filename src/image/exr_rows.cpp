#include "image/exr_rows.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "base/files.h"
#include "image/exr_header.h"

namespace drude {

namespace {

// Rows that are handed to OpenEXR at once: what PIZ compresses together.
constexpr int rows_at_once = 32;

// What OpenEXR writes goes through our own descriptor: the library's stream class forgets errors
// that happen while it closes, and a full disk shows up exactly there.
class DescriptorStream : public Imf::OStream {
  public:
    DescriptorStream(const std::string& path, const std::string& target)
        : OStream(target.c_str()), target_(target) {
        descriptor_ = open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
        if (descriptor_ < 0) outside_error("{}: cannot write: {}", target_, std::strerror(errno));
    }
    ~DescriptorStream() override {
        if (descriptor_ >= 0) close(descriptor_);
    }
    DescriptorStream(const DescriptorStream&) = delete;
    DescriptorStream& operator=(const DescriptorStream&) = delete;

    void write(const char bytes[], int count) override {
        buffer_.append(bytes, static_cast<size_t>(count));
        if (buffer_.size() >= (size_t{1} << 20)) flush();
    }
    uint64_t tellp() override { return start_ + buffer_.size(); }
    void seekp(uint64_t position) override {
        flush();
        start_ = position;
    }
    // The last bytes and any error that OpenEXR swallowed.
    void finish() {
        flush();
        const int descriptor = descriptor_;
        descriptor_ = -1;
        if (close(descriptor) != 0) fail();
    }

  private:
    [[noreturn]] void fail() {
        if (error_ == 0) error_ = errno;
        outside_error("{}: cannot write: {}", target_, std::strerror(error_));
    }
    void flush() {
        if (error_ != 0) fail();
        size_t done = 0;
        while (done < buffer_.size()) {
            const ssize_t count = pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done,
                                         static_cast<off_t>(start_ + done));
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail();
            done += static_cast<size_t>(count);
        }
        start_ += buffer_.size();
        buffer_.clear();
    }

    std::string target_;
    std::string buffer_;
    uint64_t start_ = 0;
    int descriptor_ = -1;
    int error_ = 0;
};

void check_before_writing(const ExrPicture& picture) {
    if (picture.width < 1 || picture.height < 1 || picture.channels.empty()) {
        throw std::logic_error("write_exr: an image without pixels or channels");
    }
    std::vector<std::string> names;
    for (const ExrChannel& channel : picture.channels) {
        if (channel.name.empty()) throw std::logic_error("write_exr: a channel without a name");
        names.push_back(channel.name);
    }
    std::sort(names.begin(), names.end());
    if (std::adjacent_find(names.begin(), names.end()) != names.end()) {
        throw std::logic_error("write_exr: two channels of one name");
    }
    for (const auto& attribute : picture.attributes) {
        if (attribute.first.empty() || belongs_to_openexr(attribute.first)) {
            throw std::logic_error("write_exr: attribute name '" + attribute.first + "'");
        }
    }
}

Imf::Compression imf_compression(Compression compression) {
    switch (compression) {
        case Compression::none:
            return Imf::NO_COMPRESSION;
        case Compression::piz:
            return Imf::PIZ_COMPRESSION;
        case Compression::zip:
            return Imf::ZIP_COMPRESSION;
    }
    throw std::logic_error("write_exr: unknown compression");
}

Imf::Header header_of(const ExrPicture& picture, Compression compression) {
    Imf::Header header(picture.width, picture.height);
    header.compression() = imf_compression(compression);
    for (const ExrChannel& channel : picture.channels) {
        const bool whole = channel.samples == ExrSamples::uint32;
        header.channels().insert(channel.name, Imf::Channel(whole ? Imf::UINT : Imf::FLOAT));
    }
    for (const auto& attribute : picture.attributes) {
        const char* name = attribute.first.c_str();
        if (const auto* text = std::get_if<std::string>(&attribute.second)) {
            header.insert(name, Imf::StringAttribute(*text));
        } else if (const auto* whole = std::get_if<int>(&attribute.second)) {
            header.insert(name, Imf::IntAttribute(*whole));
        } else {
            header.insert(name, Imf::FloatAttribute(std::get<float>(attribute.second)));
        }
    }
    return header;
}

// Rows of all channels, side by side: [row][channel][x].
class RowBuffer {
  public:
    RowBuffer(const ExrPicture& picture, int rows)
        : picture_(picture),
          width_(static_cast<size_t>(picture.width)),
          row_words_(width_ * picture.channels.size()),
          words_(row_words_ * static_cast<size_t>(rows)) {}

    uint32_t* row(int i) { return &words_[row_words_ * static_cast<size_t>(i)]; }
    size_t row_words() const { return row_words_; }

    // For a file whose rows and columns count from (x, y); the buffer's first row is its row
    // `first`.
    Imf::FrameBuffer frame(int x, int y, int first) {
        Imf::FrameBuffer result;
        const size_t x_stride = sizeof(uint32_t), y_stride = x_stride * row_words_;
        for (size_t c = 0; c < picture_.channels.size(); ++c) {
            // OpenEXR wants the address of its pixel (0, 0), which may lie outside the buffer: an
            // address that is only counted from, so it is made of integers.
            const intptr_t base = reinterpret_cast<intptr_t>(&words_[c * width_]) -
                                  static_cast<intptr_t>(x_stride) * x -
                                  static_cast<intptr_t>(y_stride) * (int64_t{y} + first);
            const bool whole = picture_.channels[c].samples == ExrSamples::uint32;
            // A slice begins where the window's origin would be, which no pointer may point to.
            // NOLINTNEXTLINE(performance-no-int-to-ptr)
            char* const origin = reinterpret_cast<char*>(base);
            result.insert(picture_.channels[c].name,
                          Imf::Slice(whole ? Imf::UINT : Imf::FLOAT, origin, x_stride, y_stride));
        }
        return result;
    }

  private:
    const ExrPicture& picture_;
    size_t width_, row_words_;
    std::vector<uint32_t> words_;
};

}  // namespace

void write_exr_rows(const std::string& path, const ExrPicture& picture, Compression compression,
                    const ExrRowSource& rows) {
    check_before_writing(picture);
    const Imf::Header header = header_of(picture, compression);
    AtomicFile file(path);
    {
        DescriptorStream stream(file.temporary_path(), path);
        // What the source of the rows throws is no fault of the disk's.
        std::exception_ptr of_the_rows;
        try {
            Imf::OutputFile output(stream, header, 0);
            RowBuffer buffer(picture, std::min(rows_at_once, picture.height));
            for (int first = 0; first < picture.height; first += rows_at_once) {
                const int count = std::min(rows_at_once, picture.height - first);
                try {
                    for (int i = 0; i < count; ++i) rows(first + i, buffer.row(i));
                } catch (...) {
                    of_the_rows = std::current_exception();
                    throw;
                }
                output.setFrameBuffer(buffer.frame(0, 0, first));
                output.writePixels(count);
            }
        } catch (const Error&) {
            throw;
        } catch (const std::exception& error) {
            if (of_the_rows) std::rethrow_exception(of_the_rows);
            stream.finish();  // says what the disk said, where it was the disk
            outside_error("{}: cannot write: {}", path, error.what());
        }
        stream.finish();
    }
    file.commit();
}

struct ExrRowReader::File {
    explicit File(const std::string& path) : file(path.c_str(), 0, false) {}

    Imf::MultiPartInputFile file;
    std::unique_ptr<Imf::InputPart> part;
    std::unique_ptr<RowBuffer> buffer;
    int x = 0, y = 0;          // of the data window
    int first = 0, count = 0;  // rows in the buffer
};

ExrRowReader::ExrRowReader(const std::string& path) : path_(path) {
    check_exr_file(path);
    try {
        file_ = std::make_unique<File>(path);
        if (file_->file.parts() < 1) user_error("{}: holds no picture", path);
        const Imf::Header& header = file_->file.header(0);
        const ExrSize size = exr_size(header, path);
        picture_.width = size.width;
        picture_.height = size.height;
        if (header.hasType() && header.type() != Imf::SCANLINEIMAGE) {
            user_error("{}: holds no scan lines; expected a file that 'drude render' wrote", path);
        }
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
            if (it.channel().xSampling != 1 || it.channel().ySampling != 1 ||
                it.channel().type == Imf::HALF) {
                user_error("{}: channel '{}' is subsampled or half; expected float or uint", path,
                           it.name());
            }
            picture_.channels.push_back({it.name(), it.channel().type == Imf::UINT
                                                        ? ExrSamples::uint32
                                                        : ExrSamples::float32});
        }
        if (picture_.channels.empty()) user_error("{}: has no channels", path);
        picture_.attributes = exr_attributes(header);
        file_->part = std::make_unique<Imf::InputPart>(file_->file, 0);
        file_->x = header.dataWindow().min.x;
        file_->y = header.dataWindow().min.y;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        user_error("{}: the picture that its header describes does not fit into memory", path);
    } catch (const std::exception&) {
        user_error("{}: damaged or truncated OpenEXR file; write or copy it again", path);
    }
}

ExrRowReader::~ExrRowReader() = default;

void ExrRowReader::read(int y, uint32_t* words) {
    File& f = *file_;
    try {
        if (y < f.first || y >= f.first + f.count) {
            if (!f.buffer) {
                f.buffer =
                    std::make_unique<RowBuffer>(picture_, std::min(rows_at_once, picture_.height));
            }
            f.count = 0;
            f.first = y / rows_at_once * rows_at_once;
            const int count = std::min(rows_at_once, picture_.height - f.first);
            f.part->setFrameBuffer(f.buffer->frame(f.x, f.y, f.first));
            f.part->readPixels(f.y + f.first, f.y + f.first + count - 1);
            f.count = count;
        }
        std::copy_n(f.buffer->row(y - f.first), f.buffer->row_words(), words);
    } catch (const std::exception&) {
        user_error("{}: damaged or truncated OpenEXR file; write or copy it again", path_);
    }
}

}  // namespace drude
