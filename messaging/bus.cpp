// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/bus.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <new>
#include <stdexcept>
#include <utility>

#include "messaging/config.hpp"
#include "messaging/log.hpp"

namespace geomap::messaging {
namespace {

constexpr int kQueueCapacity = 100'000;  // LCM's own queue; ours is behind it
constexpr int kPollMilliseconds = 50;    // until the receiver looks whether it shall end
constexpr int kRetryMilliseconds = 500;
constexpr std::size_t kLongestName = 63;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '/';
}

bool is_tcp(const std::string& url) { return url.starts_with("tcpq:"); }

// "tcpq://HOST:PORT?options" or "udpm://..." as host and port, with LCM's defaults.
std::pair<std::string, std::string> address_of(const std::string& url) {
  std::string address = url.substr(url.find("//") == std::string::npos ? 5 : url.find("//") + 2);
  address = address.substr(0, address.find('?'));
  const std::size_t colon = address.find(':');
  const std::string host = address.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  return {host.empty() ? (is_tcp(url) ? "127.0.0.1" : "239.255.76.67") : host,
          port.empty() ? (is_tcp(url) ? "7700" : "7667") : port};
}

// Does anybody listen? LCM itself loses a file descriptor with each attempt that fails.
bool answers(const std::string& url) {
  const auto [host, port] = address_of(url);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) return false;
  bool is_listening = false;
  for (const addrinfo* at = found; at != nullptr && !is_listening; at = at->ai_next) {
    const int descriptor = socket(at->ai_family, at->ai_socktype, at->ai_protocol);
    if (descriptor < 0) continue;
    is_listening = connect(descriptor, at->ai_addr, at->ai_addrlen) == 0;
    close(descriptor);
  }
  freeaddrinfo(found);
  return is_listening;
}

}  // namespace

// Over multicast the port decides: a socket hears all groups that any process of its host has
// joined.
bool is_same_bus(const std::string& url, const std::string& other) {
  if (is_tcp(url) != is_tcp(other)) return false;
  const auto [host, port] = address_of(url);
  const auto [other_host, other_port] = address_of(other);
  return port == other_port && (!is_tcp(url) || host == other_host);
}

Bus::Bus(const BusConfig& config)
    : config_(config),
      inbox_(static_cast<std::size_t>(1e6 * config.spool_mb),
             config.lossless && is_tcp(config.url) ? WhenFull::kWait : WhenFull::kDrop) {
  const std::string& prefix = config_.channel_prefix;
  if (prefix.size() > kLongestName / 2 || !std::all_of(prefix.begin(), prefix.end(), is_plain)) {
    throw ConfigError("--channel-prefix '" + prefix +
                      "': up to 31 letters, digits, and any of _ - /");
  }
  if (is_tcp(config_.url) && !answers(config_.url)) {
    throw std::runtime_error(
        "no LCM broker answers at " + config_.url +
        ": start one with java -cp /usr/share/java/lcm.jar lcm.lcm.TCPService");
  }
  lcm_ = std::make_unique<lcm::LCM>(config_.url);
  if (!lcm_->good()) {
    throw std::runtime_error("cannot open LCM at " + config_.url +
                             ": no such network, or no multicast route (on one machine: ip route "
                             "add 224.0.0.0/4 dev lo)");
  }
}

Bus::~Bus() { stop_receiving(); }

void Bus::subscribe(const std::string& channel, Keep keep) {
  const std::string name = config_.channel_prefix + channel;
  keep_[name] = config_.lossless ? Keep::kEvery : keep;
  lcm_->subscribe(name, &Bus::handle, this)->setQueueCapacity(kQueueCapacity);
}

// The prefix has no character with a meaning in LCM's regular expressions.
void Bus::subscribe_all() {
  lcm_->subscribe(config_.channel_prefix + ".*", &Bus::handle, this)
      ->setQueueCapacity(kQueueCapacity);
}

void Bus::start() {
  is_receiving_ = true;
  receiver_ = std::thread([this] { receive(); });
}

void Bus::stop_receiving() {
  is_receiving_ = false;
  inbox_.close();
  if (receiver_.joinable()) receiver_.join();
}

void Bus::receive() {
  while (is_receiving_) {
    if (lcm_->handleTimeout(kPollMilliseconds) >= 0) continue;
    if (is_tcp(config_.url)) {
      wait_for_broker();
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(kPollMilliseconds));
    }
  }
}

void Bus::wait_for_broker() {
  is_connected_ = false;
  log_warning("the LCM broker at " + config_.url + " is away");
  while (is_receiving_ && !answers(config_.url)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kRetryMilliseconds));
  }
  is_connected_ = true;
}

void Bus::handle(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  const auto* data = static_cast<const std::uint8_t*>(buffer->data);
  try {  // nothing may be thrown through LCM
    const auto keep = keep_.find(channel);
    inbox_.put({channel.substr(config_.channel_prefix.size()), {data, data + buffer->data_size}},
               keep == keep_.end() ? Keep::kEvery : keep->second);
  } catch (const std::bad_alloc&) {
    inbox_.note_overflow();
  }
}

void Bus::publish_bytes(const std::string& channel, const std::vector<std::uint8_t>& data) {
  const std::string name = config_.channel_prefix + channel;
  if (!is_connected_ ||
      lcm_->publish(name, data.data(), static_cast<unsigned int>(data.size())) != 0) {
    ++unsent_;
  }
}

}  // namespace geomap::messaging
