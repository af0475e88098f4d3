#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/error.h"

namespace drude {

std::string read_file(const std::string& path, uint64_t limit_bytes) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) user_error("{}: is a folder; expected a file", path);
    // zlib's reader passes plain files through untouched, so one path serves both.
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
    if (!file) user_error("{}: cannot open: {}", path, std::strerror(errno));
    std::string bytes;
    char buffer[1 << 16];
    for (;;) {
        const int count = gzread(file.get(), buffer, sizeof buffer);
        if (count < 0) {
            int code = 0;
            const char* reason = gzerror(file.get(), &code);
            user_error("{}: cannot read: {}", path,
                       code == Z_ERRNO ? std::strerror(errno) : reason);
        }
        if (count == 0) break;
        bytes.append(buffer, static_cast<size_t>(count));
        if (bytes.size() > limit_bytes) {
            user_error("{}: larger than {} MiB", path, limit_bytes >> 20);
        }
    }
    return bytes;
}

namespace {

std::string temporary_name(const std::string& path) {
    static std::atomic<unsigned> counter{0};
    const std::filesystem::path target(path);
    std::filesystem::path name = target.parent_path();
    name /= fmt::format(".{}.{}-{}.tmp{}", target.stem().string(), getpid(), counter++,
                        target.extension().string());
    return name.string();
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_path_(temporary_name(path_)) {
    struct stat status {};
    if (stat(path_.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
        user_error("{}: is a folder; expected a file name to write to", path_);
    }
    descriptor_ = open(temporary_path_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0) outside_error("{}: cannot write: {}", path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!committed_) unlink(temporary_path_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0) {
            if (errno == EINTR) continue;
            outside_error("{}: cannot write: {}", path_, std::strerror(errno));
        }
        bytes.remove_prefix(static_cast<size_t>(count));
    }
}

void AtomicFile::commit() {
    if (fsync(descriptor_) != 0) {
        outside_error("{}: cannot write: {}", path_, std::strerror(errno));
    }
    if (rename(temporary_path_.c_str(), path_.c_str()) != 0) {
        outside_error("{}: cannot write: {}", path_, std::strerror(errno));
    }
    committed_ = true;
    // The rename itself must reach the disk too; a file system that cannot sync a folder
    // (EINVAL) has nothing more to offer.
    const std::string parent = std::filesystem::path(path_).parent_path().string();
    const int folder = open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
}

void write_file(const std::string& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) outside_error("{}: cannot create the folder: {}", path, error.message());
    if (!std::filesystem::is_directory(path)) outside_error("{}: is not a folder", path);
}

}  // namespace drude
