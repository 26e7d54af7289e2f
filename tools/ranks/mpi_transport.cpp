// SPDX-License-Identifier: BSD-3-Clause
// The ranks of a run joined by MPI: a shared object of its own, loaded only in a process that mpirun has started, so
// that the program needs no MPI otherwise.
//
// One allgather of blocks of fixed size, most often enough, and one more of the rest. Both are polled, since a
// rank may be lost: MPI itself would wait for ever. A rank that waits for long tells the first one, which so knows the
// ranks that have not come.
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "modules/run/ranks/transport.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t block_bytes = 4096, block_room = block_bytes - sizeof(std::uint64_t);
// The tags of messages to the first rank, and from it.
constexpr int i_wait = 1, i_failed = 2;

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

class MpiTransport final : public run::Transport {
 public:
  MpiTransport() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    blocks_.resize(static_cast<std::size_t>(ranks_) * block_bytes);
    came_.resize(static_cast<std::size_t>(ranks_));
  }
  // After a failed wait the others do not come to the end together.
  ~MpiTransport() override {
    if (!has_failed_) MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }

  std::string host() const override {
    char name[256] = "";
    gethostname(name, sizeof name - 1);
    return name;
  }

  const std::vector<std::string_view>& gather(std::string_view block, const Waiting& waiting) override {
    ++number_;
    char own[block_bytes];
    const std::uint64_t size = block.size();
    const std::size_t first = std::min(block.size(), block_room);
    std::memcpy(own, &size, sizeof size);
    std::memcpy(own + sizeof size, block.data(), first);
    std::memset(own + sizeof size + first, 0, block_room - first);
    MPI_Request request;
    MPI_Iallgather(own, block_bytes, MPI_BYTE, blocks_.data(), block_bytes, MPI_BYTE, MPI_COMM_WORLD, &request);
    wait(request, waiting);
    gather_rest(block.substr(first), waiting);
    return views_;
  }

  bool has_first_failed() override {
    int is_there = 0;
    MPI_Iprobe(0, i_failed, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
    return is_there != 0;
  }

  std::string missing() override {
    std::string names;
    for (std::size_t i = 1; i < came_.size(); ++i)
      if (came_[i] + 1 < number_) names += (names.empty() ? "rank " : ", rank ") + std::to_string(i);
    return names;
  }

 private:
  // The rest, beyond the blocks of fixed size.
  void gather_rest(std::string_view own, const Waiting& waiting) {
    std::vector<int> sizes, places;
    std::size_t sum = 0;
    for (int i = 0; i < ranks_; ++i) {
      const std::size_t size = size_of(i);
      places.push_back(static_cast<int>(sum));
      sizes.push_back(static_cast<int>(size - std::min(size, block_room)));
      sum += static_cast<std::size_t>(sizes.back());
    }
    rest_.resize(sum);
    if (sum > 0) {
      MPI_Request request;
      MPI_Iallgatherv(own.data(), static_cast<int>(own.size()), MPI_BYTE, rest_.data(), sizes.data(), places.data(),
                      MPI_BYTE, MPI_COMM_WORLD, &request);
      wait(request, waiting);
    }
    views_.clear();
    whole_.clear();
    whole_.resize(static_cast<std::size_t>(ranks_));
    for (int i = 0; i < ranks_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const char* const begin = blocks_.data() + at * block_bytes + sizeof(std::uint64_t);
      const std::size_t size = size_of(i);
      if (size <= block_room) {
        views_.emplace_back(begin, size);
        continue;
      }
      whole_[at].assign(begin, block_room);
      whole_[at].append(rest_.data() + places[at], static_cast<std::size_t>(sizes[at]));
      views_.emplace_back(whole_[at]);
    }
  }

  std::size_t size_of(int rank) const {
    std::uint64_t size = 0;
    std::memcpy(&size, blocks_.data() + static_cast<std::size_t>(rank) * block_bytes, sizeof size);
    return size;
  }

  void wait(MPI_Request& request, const Waiting& waiting) {
    constexpr int quick_polls = 1000;
    constexpr double between_calls_s = 0.1, sleep_after_s = 0.02;
    constexpr unsigned pause_us = 200;
    int done = 0;
    for (int i = 0; i < quick_polls && done == 0; ++i) MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    const double begin_s = clock_s();
    double called_s = begin_s;
    bool has_told = false;
    for (;;) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done != 0) return;
      const double now_s = clock_s();
      now_s - begin_s < sleep_after_s ? static_cast<void>(sched_yield()) : static_cast<void>(usleep(pause_us));
      if (now_s - called_s < between_calls_s) continue;
      called_s = now_s;
      if (rank_ == 0)
        take_told();
      else if (!std::exchange(has_told, true))
        tell(0, i_wait);
      try {
        waiting(now_s - begin_s);
      } catch (...) {
        has_failed_ = true;
        for (int i = 1; i < ranks_ && rank_ == 0; ++i) tell(i, i_failed);
        throw;
      }
    }
  }

  // In the background: the other one may not be there any more.
  void tell(int rank, int what) {
    announced_ = number_;
    MPI_Request request;
    MPI_Isend(&announced_, 1, MPI_UINT64_T, rank, what, MPI_COMM_WORLD, &request);
    MPI_Request_free(&request);
  }

  void take_told() {
    for (;;) {
      int is_there = 0;
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, i_wait, MPI_COMM_WORLD, &is_there, &status);
      if (is_there == 0) return;
      MPI_Recv(&came_[static_cast<std::size_t>(status.MPI_SOURCE)], 1, MPI_UINT64_T, status.MPI_SOURCE, i_wait,
               MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
  }

  int rank_ = 0, ranks_ = 1;
  bool has_failed_ = false;
  std::uint64_t number_ = 0;         // of the present call of gather()
  std::uint64_t announced_ = 0;      // sent in the background
  std::vector<std::uint64_t> came_;  // by rank: the last call it is known to wait in, this one or the one before
  std::vector<char> blocks_;
  std::string rest_;
  std::vector<std::string> whole_;
  std::vector<std::string_view> views_;
};

}  // namespace
}  // namespace waitpoint::tools

extern "C" [[gnu::visibility("default")]] waitpoint::run::Transport* waitpoint_join_ranks() {
  return new waitpoint::tools::MpiTransport();
}
