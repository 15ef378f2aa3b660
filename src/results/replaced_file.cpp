#include "results/replaced_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <gnomon/error.hpp>
#include <system_error>

namespace gnomon {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& target, int error) {
  throw Error(fmt::format("cannot write {}: {}", target.string(), std::strerror(error)));
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& target) {
  std::filesystem::path part = target;
  part += ".part";
  return part;
}

std::filesystem::path replaceable(const std::filesystem::path& target) {
  std::error_code error;
  const auto status = std::filesystem::status(target, error);
  if (!std::filesystem::exists(status)) return target;
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(fmt::format("cannot write {}: it is not a regular file", target.string()));
  }
  if (access(target.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("cannot write {}: {}", target.string(), std::strerror(errno)));
  }
  return std::filesystem::canonical(target);
}

void publish_part(const std::filesystem::path& target) {
  std::error_code error;
  std::filesystem::rename(part_of(target), target, error);
  if (error) {
    unlink(part_of(target).c_str());
    refuse(target, error.value());
  }
}

void replace_text(const std::filesystem::path& target, const std::string& text) {
  const auto part = part_of(target);
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(target, errno);
  int error = 0;
  for (std::size_t done = 0; done < text.size() && error == 0;) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written > 0) done += static_cast<std::size_t>(written);
    if (written < 0 && errno != EINTR) error = errno;
  }
  close(descriptor);
  if (error != 0) {
    unlink(part.c_str());
    refuse(target, error);
  }
  publish_part(target);
}

}  // namespace gnomon
