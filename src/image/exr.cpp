// OpenEXR files, without OpenImageIO: its own names and attributes pass untouched.
#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
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
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"

namespace drude {

namespace {

// Attributes that OpenEXR itself writes or derives.
bool belongs_to_openexr(std::string_view name) {
    static constexpr std::array<std::string_view, 18> names = {"channels",
                                                               "compression",
                                                               "dataWindow",
                                                               "displayWindow",
                                                               "lineOrder",
                                                               "pixelAspectRatio",
                                                               "screenWindowCenter",
                                                               "screenWindowWidth",
                                                               "tiles",
                                                               "type",
                                                               "name",
                                                               "version",
                                                               "chunkCount",
                                                               "view",
                                                               "preview",
                                                               "multiView",
                                                               "maxSamplesPerPixel",
                                                               "dwaCompressionLevel"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

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

void check_file(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) user_error("{}: is a folder; expected an OpenEXR file", path);
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) user_error("{}: cannot open: {}", path, std::strerror(errno));
    unsigned char magic[4] = {};
    const ssize_t count = read(descriptor, magic, sizeof magic);
    close(descriptor);
    static constexpr unsigned char expected[4] = {0x76, 0x2f, 0x31, 0x01};
    if (count != 4 || std::memcmp(magic, expected, 4) != 0) {
        user_error("{}: is no OpenEXR file (it does not start with its four-byte signature)", path);
    }
}

void read_attributes(const Imf::Header& header, Image& image) {
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (belongs_to_openexr(it.name())) continue;
        const Imf::Attribute& attribute = it.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
            image.attributes[it.name()] = text->value();
        } else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
            image.attributes[it.name()] = whole->value();
        } else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
            image.attributes[it.name()] = real->value();
        } else if (const auto* wide = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
            image.attributes[it.name()] = static_cast<float>(wide->value());
        }
    }
}

// Width and height of the data window, once they are known to be sane.
void read_size(const Imf::Header& header, const std::string& path, Image& image) {
    const auto& window = header.dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1) {
        user_error("{}: the data window is {} x {} pixels; expected at least 1 x 1", path, width,
                   height);
    }
    // Divided, not multiplied: a damaged header can hold sides whose product overflows.
    if (static_cast<uint64_t>(width) > largest_picture / static_cast<uint64_t>(height)) {
        user_error("{}: the data window is {} x {} pixels; the most that is read is {} pixels",
                   path, width, height, largest_picture);
    }
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
}

Image read_part(Imf::MultiPartInputFile& file, const std::string& path) {
    const Imf::Header& header = file.header(0);
    Image image;
    read_size(header, path, image);
    if (header.hasType() && Imf::isDeepData(header.type())) {
        user_error("{}: holds deep data; expected one value a pixel and channel", path);
    }
    const Imf::ChannelList& list = header.channels();
    for (auto it = list.begin(); it != list.end(); ++it) {
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
            user_error("{}: channel '{}' is subsampled; write it at full resolution", path,
                       it.name());
        }
        image.channels.push_back({it.name(), {}});
    }
    if (image.channels.empty()) user_error("{}: has no channels", path);
    read_attributes(header, image);

    // Memory is reserved, but touched only as rows are decoded: a damaged header that promises
    // more than the file holds costs nothing.
    const size_t width = static_cast<size_t>(image.width);
    for (Channel& channel : image.channels) channel.data.reserve(image.pixels());
    Imf::InputPart part(file, 0);
    const auto& window = header.dataWindow();
    constexpr int rows_at_once = 256;
    for (int row = 0; row < image.height; row += rows_at_once) {
        const int end = std::min(image.height, row + rows_at_once);
        Imf::FrameBuffer frame;
        for (Channel& channel : image.channels) {
            channel.data.resize(static_cast<size_t>(end) * width);
            frame.insert(channel.name,
                         Imf::Slice::Make(Imf::FLOAT, channel.data.data(), window.min, image.width,
                                          image.height, sizeof(float), sizeof(float) * width));
        }
        part.setFrameBuffer(frame);
        part.readPixels(window.min.y + row, window.min.y + end - 1);
    }
    return image;
}

void check_before_writing(const Image& image) {
    if (image.width < 1 || image.height < 1 || image.channels.empty()) {
        throw std::logic_error("write_exr: an image without pixels or channels");
    }
    std::vector<std::string> names;
    for (const Channel& channel : image.channels) {
        if (channel.data.size() != image.pixels() || channel.name.empty()) {
            throw std::logic_error("write_exr: channel '" + channel.name + "' has a wrong size");
        }
        names.push_back(channel.name);
    }
    std::sort(names.begin(), names.end());
    if (std::adjacent_find(names.begin(), names.end()) != names.end()) {
        throw std::logic_error("write_exr: two channels of one name");
    }
    for (const auto& attribute : image.attributes) {
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

}  // namespace

Image read_exr(const std::string& path) {
    check_file(path);
    // Line tables are as long as a header says; no side may be longer than any picture needs.
    static const bool limited = [] {
        Imf::Header::setMaxImageSize(1 << 24, 1 << 24);
        return true;
    }();
    static_cast<void>(limited);
    try {
        Imf::MultiPartInputFile file(path.c_str(), 0, false);
        if (file.parts() < 1) user_error("{}: holds no picture", path);
        return read_part(file, path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        user_error("{}: the picture that its header describes does not fit into memory", path);
    } catch (const std::exception&) {
        user_error("{}: damaged or truncated OpenEXR file; write or copy it again", path);
    }
}

void write_exr(const std::string& path, const Image& image, Compression compression) {
    check_before_writing(image);
    Imf::Header header(image.width, image.height);
    header.compression() = imf_compression(compression);
    Imf::FrameBuffer frame;
    const size_t row = sizeof(float) * static_cast<size_t>(image.width);
    for (const Channel& channel : image.channels) {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        // A frame buffer serves reading and writing, so it wants the pointer without const.
        char* base = const_cast<char*>(reinterpret_cast<const char*>(channel.data.data()));
        frame.insert(channel.name, Imf::Slice(Imf::FLOAT, base, sizeof(float), row));
    }
    for (const auto& attribute : image.attributes) {
        const char* name = attribute.first.c_str();
        if (const auto* text = std::get_if<std::string>(&attribute.second)) {
            header.insert(name, Imf::StringAttribute(*text));
        } else if (const auto* whole = std::get_if<int>(&attribute.second)) {
            header.insert(name, Imf::IntAttribute(*whole));
        } else {
            header.insert(name, Imf::FloatAttribute(std::get<float>(attribute.second)));
        }
    }
    AtomicFile file(path);
    {
        DescriptorStream stream(file.temporary_path(), path);
        try {
            Imf::OutputFile output(stream, header, 0);
            output.setFrameBuffer(frame);
            output.writePixels(image.height);
        } catch (const Error&) {
            throw;
        } catch (const std::exception& error) {
            stream.finish();  // says what the disk said, where it was the disk
            outside_error("{}: cannot write: {}", path, error.what());
        }
        stream.finish();
    }
    file.commit();
}

}  // namespace drude
