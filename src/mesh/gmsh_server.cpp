#include "mesh/gmsh_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <mutex>
#include <utility>

extern char** environ;

namespace gnomon {

namespace {

/// Closed when it goes out of scope.
struct Descriptor {
  int number = -1;

  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close_now(); }
  void close_now() {
    if (number >= 0) close(number);
    number = -1;
  }
};

void demand(int code, const char* what) {
  if (code) throw Error(fmt::format("cannot start Gmsh: {}: {}", what, std::strerror(code)));
}

/// Gmsh and what it is made of print to a terminal whatever their settings; here they have none.
pid_t start_program(std::string program, int socket) {
  posix_spawn_file_actions_t actions;
  demand(posix_spawn_file_actions_init(&actions), "actions");
  demand(posix_spawn_file_actions_adddup2(&actions, socket, mesh_request::descriptor), "socket");
  for (int stream : {0, 1, 2})
    demand(posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0), "streams");
  char* arguments[] = {program.data(), nullptr};
  pid_t process = 0;
  const int failed = posix_spawn(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  demand(failed, program.c_str());
  return process;
}

}  // namespace

void GmshServer::start() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends)) demand(errno, "socket");
  Descriptor own, other;
  own.number = ends[0];
  other.number = ends[1];
  process_ = start_program(installed("libexec/gnomon/gnomon_gmsh").string(), other.number);
  owner_ = getpid();
  std::swap(socket_, own.number);
}

void GmshServer::end() {
  if (is_running()) shutdown(socket_, SHUT_RDWR);  // a fork may have it open, too
  if (socket_ >= 0) close(socket_);
  if (is_running())
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  socket_ = process_ = -1;
}

/// A fork of the owner has no part in it.
bool GmshServer::is_running() const {
  return process_ > 0 && owner_ == getpid();
}

/// False where the server has ended.
bool GmshServer::send(const std::string& message, int output) const {
  iovec content{.iov_base = const_cast<char*>(message.data()), .iov_len = message.size()};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof output)] = {};
  msghdr header{};
  header.msg_iov = &content;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  cmsghdr* const passed = CMSG_FIRSTHDR(&header);
  passed->cmsg_level = SOL_SOCKET;
  passed->cmsg_type = SCM_RIGHTS;
  passed->cmsg_len = CMSG_LEN(sizeof output);
  std::memcpy(CMSG_DATA(passed), &output, sizeof output);
  ssize_t sent = 0;
  do sent = sendmsg(socket_, &header, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  if (sent < 0 && errno != EPIPE && errno != ECONNRESET) demand(errno, "request");
  return sent >= 0;
}

/// How the making of a mesh ended; none where the server itself has, as one does that is idle.
std::optional<int> GmshServer::answer(const std::string& message, const Take& take) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC)) demand(errno, "pipe");
  Descriptor input, output;
  input.number = ends[0];
  output.number = ends[1];
  if (!send(message, output.number)) return std::nullopt;
  output.close_now();
  take(input.number);
  input.close_now();  // what is still written has a reader no more
  int status = 0;
  ssize_t received = 0;
  do received = recv(socket_, &status, sizeof status, 0);
  while (received < 0 && errno == EINTR);
  return received == sizeof status ? std::optional(status) : std::nullopt;
}

int GmshServer::ask(const Words& words, const Take& take) {
  constexpr int most_starts = 3;
  static std::mutex one_at_a_time;
  static GmshServer server;
  const std::lock_guard lock(one_at_a_time);
  std::string message;
  for (const std::string& word : words) message += word + '\0';
  if (message.size() > mesh_request::longest) throw Error("a request to Gmsh is too long");
  for (int k = 0; k < most_starts; ++k) try {
      if (!server.is_running()) {
        server.end();
        server.start();
      }
      if (const std::optional<int> status = server.answer(message, take)) return *status;
      server.end();
    } catch (...) {
      server.end();
      throw;
    }
  throw Error("cannot start Gmsh: its process ends at once");
}

}  // namespace gnomon
