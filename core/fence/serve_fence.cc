#include "core/fence/serve_fence.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <malloc.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

#include "core/base/files/files.h"
#include "core/fence/fence.h"

#ifdef GRASPBENCH_ADDRESS_SANITIZED
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace graspbench {
namespace {

constexpr int kSocket = STDIN_FILENO;
constexpr rlim_t kMaxOutput = rlim_t{1} << 32;

/** Refuses every call that changes files, opens a connection or attaches to another process. Where
the kernel has no filters, everything else of the fence stands. */
void RefuseWriting() {
#if defined(__x86_64__)
  constexpr uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
  constexpr uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
  constexpr uint32_t kArchitecture = 0;  // the numbers of its calls are not known here
#endif
  constexpr auto kNumber = static_cast<uint32_t>(offsetof(seccomp_data, nr));
  // The flags are the third argument of openat, the second of open.
  constexpr auto kFlags = [](int argument) {
    return static_cast<uint32_t>(offsetof(seccomp_data, args)) +
           8U * static_cast<uint32_t>(argument);
  };
  constexpr uint32_t kWrites = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  constexpr uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
  std::vector<sock_filter> rules = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0), BPF_STMT(BPF_RET | BPF_K, kRefuse),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kNumber)};
#if defined(__x86_64__)
  rules.insert(rules.end(), {BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),  // calls of x32
                             BPF_STMT(BPF_RET | BPF_K, kRefuse)});
#endif
  const auto refuse_writing = [&](uint32_t call, int argument) {
    rules.insert(rules.end(), {BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4),
                               BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFlags(argument)),
                               BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kWrites, 0, 1),
                               BPF_STMT(BPF_RET | BPF_K, kRefuse),
                               BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)});
  };
  refuse_writing(SYS_openat, 2);
#ifdef SYS_open
  refuse_writing(SYS_open, 1);
#endif
  for (const long call : {
#ifdef SYS_creat
           SYS_creat,     SYS_unlink,    SYS_rename,  SYS_mkdir,    SYS_rmdir,     SYS_link,
           SYS_symlink,   SYS_mknod,     SYS_chmod,   SYS_chown,    SYS_lchown,
#endif
           SYS_unlinkat,  SYS_renameat2, SYS_mkdirat, SYS_linkat,   SYS_symlinkat, SYS_mknodat,
           SYS_truncate,  SYS_fchmodat,  SYS_fchmod,  SYS_fchownat, SYS_fchown,    SYS_setxattr,
           SYS_utimensat, SYS_mount,     SYS_ptrace,  SYS_connect,  SYS_bind}) {
    rules.insert(rules.end(),
                 {BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<uint32_t>(call), 0, 1),
                  BPF_STMT(BPF_RET | BPF_K, kRefuse)});
  }
#ifdef SYS_renameat
  rules.insert(rules.end(), {BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat, 0, 1),
                             BPF_STMT(BPF_RET | BPF_K, kRefuse)});
#endif
#ifdef SYS_openat2  // its flags lie in memory, where a filter cannot look: as if it did not exist
  rules.insert(rules.end(), {BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat2, 0, 1),
                             BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS)});
#endif
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog filter = {static_cast<unsigned short>(rules.size()), rules.data()};
  if (kArchitecture != 0 && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
  }
}

void SetLimit(__rlimit_resource resource, rlim_t value) {
  rlimit limit = {};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  ::setrlimit(resource, &limit);
}

/** An exception that nobody may catch: a lack of memory is told from a fault. */
[[noreturn]] void Terminate() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    ::_exit(kFenceNoMemory);
  } catch (...) {
  }
  std::abort();
}

/** The parent is gone, which a read that takes minutes would not see. */
void EndWithoutParent(int) {
  const int reason = errno;
  pollfd socket = {kSocket, 0, 0};
  if (::poll(&socket, 1, 0) > 0 && (socket.revents & POLLHUP) != 0) ::_exit(kFenceClosed);
  errno = reason;
}

/** SIGIO comes with every message and when the socket closes. */
void WatchSocket() {
  struct sigaction action = {};
  action.sa_handler = &EndWithoutParent;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGIO, &action, nullptr);
  ::fcntl(kSocket, F_SETOWN, ::getpid());
  ::fcntl(kSocket, F_SETFL, ::fcntl(kSocket, F_GETFL) | O_ASYNC);
}

/** Signals of a terminal and of a stopped job are for the parent, which closes the socket. */
void PrepareProcess() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::signal(signal, SIG_IGN);
  ::signal(SIGPROF, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  std::set_terminate(&Terminate);
  WatchSocket();
  SetLimit(RLIMIT_CORE, 0);
  SetLimit(RLIMIT_FSIZE, kMaxOutput);
  RefuseWriting();
}

/** Of the processor; 0: none. The end comes as SIGPROF. */
void LimitTime(int seconds) {
  itimerval limit = {};
  limit.it_value.tv_sec = seconds;
  ::setitimer(ITIMER_PROF, &limit, nullptr);
}

/** In GB, for a message. */
std::string LimitMemory(int file) {
  struct stat properties = {};
  ::fstat(file, &properties);
  const uint64_t size =
      kReaderMemory + kReaderMemoryPerByte * static_cast<uint64_t>(properties.st_size);
#ifndef GRASPBENCH_SANITIZED  // whose shadow memory takes terabytes
  SetLimit(RLIMIT_DATA, size);
#endif
  char text[32];
  std::snprintf(text, sizeof text, "%.2f GB",
                static_cast<double>(size) / static_cast<double>(1 << 30));
  return text;
}

#ifdef GRASPBENCH_ADDRESS_SANITIZED
// Called when a sanitizer ends the process. A lack of memory is the file's fault, as without them.
void EndAsFault() {
  const std::string what = __asan_report_present() != 0 ? __asan_get_report_description() : "";
  for (const char* limit : {"out-of-memory", "allocation-size-too-big", "rss-limit-exceeded"}) {
    if (what == limit) ::_exit(kFenceNoMemory);
  }
  ::_exit(kFenceFault);
}
#endif

/** @param name  of the file that is read. */
void WriteAnswer(const std::string& name, int file, std::string_view piece) {
  for (size_t written = 0; written < piece.size();) {
    const ssize_t count = ::write(file, piece.data() + written, piece.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const std::string reason =
          errno == EFBIG
              ? "what it holds exceeds the limit of the size of files; raise it "
                "(ulimit -f unlimited)"
              : "what it holds cannot be passed on: " + std::string(std::strerror(errno));
      throw Error(ErrorKind::kEnvironment, "\"" + name + "\" cannot be read: " + reason);
    }
    written += static_cast<size_t>(count);
  }
}

void Refuse(const std::string& name, int file, ErrorKind kind, std::string message) {
  if (::ftruncate(file, 0) != 0) ::_exit(kFenceFault);
  ::lseek(file, 0, SEEK_SET);
  OutgoingValues answer([&](std::string_view piece) { WriteAnswer(name, file, piece); });
  const char status = kIsRefused;
  answer.Bytes(&status, 1);
  Cross(answer, kind, message);
  answer.Flush();
}

/** A message names the file, not the way by which it came. */
std::string NameFile(std::string message, const FencedInput& input) {
  const std::string path = input.path();
  for (size_t at = message.find(path); at != std::string::npos; at = message.find(path, at)) {
    message.replace(at, path.size(), input.name());
    at += input.name().size();
  }
  return message;
}

void Serve(const std::vector<FencedReader>& readers, const std::vector<int>& files) {
  const std::string request = ReadFile("/proc/self/fd/" + std::to_string(files[0]));
  IncomingValues values(request);
  std::string id, name, sent;
  int seconds = 0;
  Cross(values, id, name, seconds, sent);
  const FencedInput input(files[1], name);
  const std::string memory = LimitMemory(files[1]);
  LimitTime(seconds);
  try {
    OutgoingValues answer([&](std::string_view piece) { WriteAnswer(name, files[2], piece); });
    const char status = kIsRead;
    answer.Bytes(&status, 1);
    IncomingValues arguments(sent);
    bool is_known = false;
    for (const FencedReader& reader : readers) {
      if (id != reader.id) continue;
      is_known = true;
      reader.read(input, arguments, answer);
    }
    if (!is_known) throw Error(ErrorKind::kEnvironment, "graspbench-reader does not know " + id);
    answer.Flush();
  } catch (const Error& error) {
    Refuse(name, files[2], error.kind(), NameFile(error.what(), input));
  } catch (const std::bad_alloc&) {
    Refuse(
        name, files[2], ErrorKind::kFormat,
        "\"" + name + "\" cannot be read (it takes more than " + memory +
            " of memory: 1 GB and four times its size); the file may be damaged, export it again "
            "from its program or cut it into smaller ones");
  } catch (const std::exception& fault) {
    Refuse(name, files[2], ErrorKind::kFormat,
           "\"" + name + "\" cannot be read (" + fault.what() +
               "); the file may be cut off or damaged, export it again from its program");
  }
  LimitTime(0);
}

}  // namespace

bool SendFencePacket(int socket, std::string_view text, const std::vector<int>& files) {
  iovec part = {const_cast<char*>(text.data()), text.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int) * kMaxFenceFiles)> control{};
  msghdr message = {};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  if (!files.empty()) {
    message.msg_control = control.data();
    message.msg_controllen = CMSG_SPACE(sizeof(int) * files.size());
    cmsghdr* const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int) * files.size());
    std::memcpy(CMSG_DATA(head), files.data(), sizeof(int) * files.size());
  }
  ssize_t count = -1;
  while ((count = ::sendmsg(socket, &message, MSG_NOSIGNAL)) < 0 && errno == EINTR) continue;
  return count >= 0;
}

std::optional<FencePacket> ReceiveFencePacket(int socket) {
  FencePacket packet;
  packet.text.resize(kMaxFenceMessage);
  iovec part = {packet.text.data(), packet.text.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int) * kMaxFenceFiles)> control{};
  msghdr message = {};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t count = -1;
  while ((count = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) continue;
  if (count <= 0) return std::nullopt;
  packet.text.resize(static_cast<size_t>(count));
  for (cmsghdr* head = CMSG_FIRSTHDR(&message); head; head = CMSG_NXTHDR(&message, head)) {
    if (head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS) continue;
    packet.files.resize((head->cmsg_len - CMSG_LEN(0)) / sizeof(int));
    std::memcpy(packet.files.data(), CMSG_DATA(head), sizeof(int) * packet.files.size());
  }
  return packet;
}

std::optional<std::string> FencedInput::ReadBeside(const std::string& name) const {
  if (name.size() + 1 > kMaxFenceMessage) return std::nullopt;
  if (!SendFencePacket(kSocket, std::string(1, kAskBeside) + name, {})) ::_exit(kFenceClosed);
  const std::optional<FencePacket> packet = ReceiveFencePacket(kSocket);
  if (!packet) ::_exit(kFenceClosed);
  if (packet->files.empty()) return std::nullopt;
  const int file = packet->files[0];
  try {
    std::string content = ReadFile("/proc/self/fd/" + std::to_string(file));
    ::close(file);
    return content;
  } catch (...) {
    ::close(file);
    throw;
  }
}

int ServeFence(const std::vector<FencedReader>& readers) {
  PrepareProcess();
#ifdef GRASPBENCH_ADDRESS_SANITIZED
  __sanitizer_set_death_callback(&EndAsFault);
#endif
  while (const std::optional<FencePacket> packet = ReceiveFencePacket(kSocket)) {
    if (packet->files.size() != kMaxFenceFiles) return kFenceFault;
    Serve(readers, packet->files);
    for (const int file : packet->files) ::close(file);
    ::malloc_trim(0);  // what one file took counts not against the next
    if (!SendFencePacket(kSocket, std::string(1, kDone), {})) break;
  }
  return kFenceClosed;
}

}  // namespace graspbench
