#include "workbench/experiments/policies/websocket_policy.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/text/text.h"
#include "core/trial/policy/policy_messages.h"
#include "core/trial/trial_setup.h"
#include "workbench/experiments/policies/child_policy.h"

namespace graspbench {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;
using WireClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kFarewellOfServer(300);
constexpr size_t kWriteBuffer = 1 << 16;  ///< a question without a picture fits [bytes]
constexpr size_t kMostServerWords = 400;  ///< of an error [bytes]

std::atomic<bool> are_remote_allowed{false};

struct ServerMessage {
  bool is_text;
  std::string bytes;
};

[[noreturn]] void LoseServer(const std::string& name, const std::string& what) {
  throw PolicyLost("the policy server " + EscapeForTerminal(name) + ": " + what);
}

using Endpoints = asio::ip::tcp::resolver::results_type;

Endpoints FindEndpoints(const PolicyServer& server) {
  asio::io_context context;
  asio::ip::tcp::resolver resolver(context);
  error_code error;
  Endpoints found = resolver.resolve(server.address.host, server.address.port, error);
  if (error) {
    LoseServer(server.source, "the host \"" + server.address.host + "\": " + error.message());
  }
  const bool is_here = std::all_of(found.begin(), found.end(), [](const auto& one) {
    return one.endpoint().address().is_loopback();
  });
  if (is_here || are_remote_allowed) return found;
  throw Error(ErrorKind::kUsage, "the policy server " + EscapeForTerminal(server.source) +
                                     " is on another machine; --allow-remote sends the "
                                     "observations there");
}

class ServerConnection {
 public:
  /** @throws PolicyLost. */
  ServerConnection(const PolicyServer& server, const Endpoints& endpoints, double timeout)
      : name_(server.source),
        address_(server.address.host + ":" + server.address.port),
        stream_(context_) {
    SetEnd(timeout);
    Connect(server.address, endpoints);
    StartReading();
  }

  ~ServerConnection() {
    if (failure_ || !stream_.is_open()) return;
    bool is_closed = false;
    stream_.async_close(websocket::close_code::normal, [&](error_code) { is_closed = true; });
    end_ = WireClock::now() + kFarewellOfServer;
    context_.restart();
    while (!is_closed && context_.run_one_until(end_) > 0) {
    }
    Abandon();
  }
  ServerConnection(const ServerConnection&) = delete;
  ServerConnection& operator=(const ServerConnection&) = delete;

  /** @throws PolicyLost, PolicyFault. */
  void Send(const std::string& message, double timeout) {
    SetEnd(timeout);
    context_.restart();
    context_.poll();
    CheckAlive();
    if (has_message_) throw PolicyFault("the server sent an unexpected extra answer");
    std::optional<error_code> result;
    stream_.binary(true);
    stream_.async_write(asio::buffer(message), [&](error_code error, size_t) { result = error; });
    Wait([&] { return result.has_value() || failure_.has_value(); });
    if (!result) Abandon();
    CheckAlive();
    if (*result) Lose("the question could not be sent: " + result->message());
  }

  ServerMessage Receive(double timeout) {
    SetEnd(timeout);
    Wait([&] { return has_message_ || failure_.has_value(); });
    if (!has_message_) CheckAlive();
    ServerMessage message = {stream_.got_text(), beast::buffers_to_string(buffer_.data())};
    buffer_.consume(buffer_.size());
    has_message_ = false;
    if (!failure_) StartReading();
    return message;
  }

 private:
  void SetEnd(double timeout) {
    timeout_ = timeout;
    end_ = WireClock::now() +
           std::chrono::duration_cast<WireClock::duration>(std::chrono::duration<double>(timeout));
  }

  [[noreturn]] void Lose(const std::string& what) const { LoseServer(name_, what); }

  template <class Condition>
  void Wait(Condition&& is_over) {
    context_.restart();
    while (!is_over()) {
      if (context_.run_one_until(end_) > 0) continue;
      Abandon();
      Lose(fmt::format("it has not answered for {:g} s of real time (policy.timeout_s)", timeout_));
    }
  }

  /** Nothing that waits outlives its caller, to which it refers. */
  void Abandon() {
    beast::get_lowest_layer(stream_).close();
    context_.restart();
    context_.poll();
  }

  void CheckAlive() const {
    if (!failure_) return;
    if (*failure_ == websocket::error::message_too_big ||
        *failure_ == websocket::error::buffer_overflow) {
      throw PolicyFault(
          fmt::format("the server sent a message of more than {} bytes", kMostAnswerBytes));
    }
    const std::string reason(stream_.reason().reason.c_str());
    Lose("it closed the connection (" + failure_->message() + ")" +
         (reason.empty() ? "" : ": " + EscapeForTerminal(reason, LineFeeds::kEscape)));
  }

  void Connect(const ServerAddress& address, const Endpoints& endpoints) {
    Await("no connection", [&](auto&& done) {
      beast::get_lowest_layer(stream_).async_connect(
          endpoints, [done](error_code its, const asio::ip::tcp::endpoint&) { done(its); });
    });
    error_code error;  // it works without, too
    beast::get_lowest_layer(stream_).socket().set_option(asio::ip::tcp::no_delay(true), error);
    stream_.read_message_max(kMostAnswerBytes);
    stream_.auto_fragment(false);
    stream_.write_buffer_bytes(kWriteBuffer);
    stream_.secure_prng(false);  // masks protect proxies from browsers; there are none here
    const std::string host =
        (address.host.find(':') != address.host.npos ? "[" + address.host + "]" : address.host) +
        ":" + address.port;
    Await("no websocket", [&](auto&& done) {
      stream_.async_handshake(host, address.path, [done](error_code its) { done(its); });
    });
  }

  /** @param start  starts what ends with done(error). */
  template <class Start>
  void Await(const std::string& otherwise, Start&& start) {
    const auto result = std::make_shared<std::optional<error_code>>();
    start([result](error_code error) { *result = error; });
    Wait([&] { return result->has_value(); });
    if (**result) Lose(otherwise + " with " + address_ + ": " + (*result)->message());
  }

  void StartReading() {
    stream_.async_read(buffer_, [this](error_code error, size_t) {
      if (error) {
        failure_ = error;
      } else {
        has_message_ = true;
      }
    });
  }

  const std::string name_, address_;
  asio::io_context context_{1};
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_{kMostAnswerBytes};
  WireClock::time_point end_;
  double timeout_ = 0.0;
  bool has_message_ = false;
  std::optional<error_code> failure_;
};

class WebsocketPolicy : public HandPolicy {
 public:
  explicit WebsocketPolicy(PolicyServer server)
      : server_(std::move(server)), endpoints_(FindEndpoints(server_)) {}

  void Begin(const PolicyView& view) override {
    connection_.reset();
    const double timeout = view.setup.policy.timeout;
    connection_ = std::make_unique<ServerConnection>(server_, endpoints_, timeout);
    const ServerMessage greeting = connection_->Receive(timeout);
    if (greeting.is_text) Lose("its greeting is an error" + Quote(greeting.bytes));
    try {
      const PackedValue metadata = ParseMessagePack(greeting.bytes);
      if (!std::holds_alternative<PackedValue::Map>(metadata.value))
        Lose("its greeting is not a map");
    } catch (const PolicyLost&) {
      throw;
    } catch (const Error& error) {
      Lose(std::string("its greeting is not metadata in MessagePack: ") + error.what());
    }
    exchange_.emplace(server_, *ParseMessagePack(FormatPolicyReset(0, view)).Find("reset"));
  }

  PolicyAction Answer(const PolicyView& view) override {
    const PolicyValues observation = FindPolicyValues(view);
    const double timeout = view.setup.policy.timeout;
    connection_->Send(exchange_->FormatQuestion(observation), timeout);
    const ServerMessage answer = connection_->Receive(timeout);
    if (answer.is_text) throw PolicyFault("the server reports an error" + Quote(answer.bytes));
    return exchange_->ReadAnswer(observation, answer.bytes);
  }

 private:
  [[noreturn]] void Lose(const std::string& what) const { LoseServer(server_.source, what); }

  /** Its end: that of a traceback says what was wrong. */
  static std::string Quote(const std::string& text) {
    const size_t start = text.size() > kMostServerWords ? text.size() - kMostServerWords : 0;
    return "; it ends with: " + FormatLastWords(text.substr(start));
  }

  const PolicyServer server_;
  const Endpoints endpoints_;
  std::unique_ptr<ServerConnection> connection_;
  std::optional<ServerExchange> exchange_;  // of the trial
};

}  // namespace

void AllowRemotePolicies() { are_remote_allowed = true; }

std::unique_ptr<HandPolicy> MakeWebsocketPolicy(PolicyServer server) {
  return std::make_unique<WebsocketPolicy>(std::move(server));
}

}  // namespace graspbench
