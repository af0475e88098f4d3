// OpenEXR files, without OpenImageIO: its own names and attributes pass untouched.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "image/exr_header.h"
#include "image/exr_rows.h"
#include "image/image.h"

namespace drude {

namespace {

Image read_part(Imf::MultiPartInputFile& file, const std::string& path) {
    const Imf::Header& header = file.header(0);
    Image image;
    const ExrSize size = exr_size(header, path);
    image.width = size.width;
    image.height = size.height;
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
    image.attributes = exr_attributes(header);

    // Memory is reserved, but touched only as rows are decoded: a damaged header that promises
    // more than the file holds costs nothing.
    const auto width = static_cast<size_t>(image.width);
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

}  // namespace

Image read_exr(const std::string& path) {
    check_exr_file(path);
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
    ExrPicture picture;
    picture.width = image.width;
    picture.height = image.height;
    picture.attributes = image.attributes;
    for (const Channel& channel : image.channels) {
        if (channel.data.size() != image.pixels()) {
            throw std::logic_error("write_exr: channel '" + channel.name + "' has a wrong size");
        }
        picture.channels.push_back({channel.name, ExrSamples::float32});
    }
    const auto width = static_cast<size_t>(image.width);
    write_exr_rows(path, picture, compression, [&](int y, uint32_t* words) {
        for (const Channel& channel : image.channels) {
            std::memcpy(words, &channel.data[static_cast<size_t>(y) * width],
                        width * sizeof(float));
            words += width;
        }
    });
}

void expect_exr_name(const std::string& command, const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension().string();
    if (ending.empty() || ending == ".exr" || ending == ".EXR") return;
    user_error("{}: found the output '{}', expected an .exr; drude tonemap makes a PNG of one",
               command, path);
}

}  // namespace drude
