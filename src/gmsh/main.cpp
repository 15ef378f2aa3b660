// The program that uses Gmsh's library. gnomon starts it with a socket (src/mesh/gmsh_server.cpp),
// on which it asks for meshes; each is made by a fork, because a damaged file, a script that says
// Exit or a failed algorithm may end that; and gnomon has its signals, its terminal and its memory
// for itself.
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "gmsh/reader.hpp"
#include "mesh/mesh_request.hpp"
#include "mesh/mesh_stream.hpp"

namespace gnomon::gmsh_reader {

namespace {

/// Those of a terminal or a queue, which are for gnomon and for the fork.
constexpr std::array<int, 2> stopping = {SIGINT, SIGTERM};
std::array<void (*)(int), 2> before{};  ///< what this process would have done

struct Request {
  std::array<std::string, mesh_request::words> words;
  int output = -1;  ///< descriptor on which the mesh is to be written
};

void wait_for_request() {
  constexpr int milliseconds = 10'000;
  pollfd watched{.fd = mesh_request::descriptor, .events = POLLIN, .revents = 0};
  if (poll(&watched, 1, milliseconds) == 0) _exit(0);
}

/// None where gnomon has ended.
std::optional<Request> next_request() {
  std::vector<char> message(mesh_request::longest);
  Request request;
  iovec content{.iov_base = message.data(), .iov_len = message.size()};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof request.output)] = {};
  msghdr header{};
  header.msg_iov = &content;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  wait_for_request();
  const ssize_t size = recvmsg(mesh_request::descriptor, &header, MSG_CMSG_CLOEXEC);
  const cmsghdr* const passed = CMSG_FIRSTHDR(&header);
  if (size <= 0 || !passed) return {};
  std::memcpy(&request.output, CMSG_DATA(passed), sizeof request.output);
  std::istringstream text(std::string(message.data(), static_cast<std::size_t>(size)));
  for (std::string& word : request.words) std::getline(text, word, '\0');
  return request;
}

[[noreturn]] void make_mesh(const Request& request) {
  const auto& [folder, file, size, factor, zone] = request.words;
  for (std::size_t k = 0; k < stopping.size(); ++k) std::signal(stopping[k], before[k]);
  dup2(request.output, mesh_stream::descriptor);  // in place of the socket
  if (chdir(folder.c_str()) != 0) _exit(2);
  // Without the ends of Gmsh's and OpenCASCADE's many static objects.
  _exit(hand_over_mesh(file, std::atof(size.c_str()), std::atof(factor.c_str()), zone));
}

/// How the making of a mesh ended, which ends at once where gnomon does.
int served(const Request& request) {
  int ends[2];  // of a pipe whose second end the fork alone has, until it ends
  if (pipe2(ends, O_CLOEXEC)) _exit(2);
  const pid_t process = fork();
  if (process < 0) _exit(2);
  if (process == 0) make_mesh(request);
  close(request.output);
  close(ends[1]);
  std::array<pollfd, 2> watched{};
  watched[0].fd = mesh_request::descriptor;
  watched[1].fd = ends[0];
  while (poll(watched.data(), watched.size(), -1) < 0 && errno == EINTR) continue;
  close(ends[0]);
  if (watched[0].revents != 0) kill(process, SIGKILL);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

}  // namespace

}  // namespace gnomon::gmsh_reader

int main() {
  using namespace gnomon;
  for (std::size_t k = 0; k < gmsh_reader::stopping.size(); ++k)
    gmsh_reader::before[k] = std::signal(gmsh_reader::stopping[k], SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  close_range(mesh_request::descriptor + 1, ~0U, 0);  // files of gnomon, which may end before
  while (const auto request = gmsh_reader::next_request()) {
    const int status = gmsh_reader::served(*request);
    if (send(mesh_request::descriptor, &status, sizeof status, 0) < 0) break;
  }
  _exit(0);
}
