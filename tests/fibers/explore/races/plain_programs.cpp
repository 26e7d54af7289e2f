// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/races/programs.hpp"

namespace waitpoint::races {
namespace {

using namespace std::chrono_literals;

// Concurrent, without any order.
template <class First, class Second>
void together(First first, Second second) {
  thread one(first), two(second);
  one.join();
  two.join();
}

template <class First, class Second>
void one_after_the_other(First first, Second second) {
  thread one(first);
  one.join();
  thread two(second);
  two.join();
}

void write_write() {
  int shared = 0;
  together([&] { shared = 1; }, [&] { shared = 2; });
}
void write_write_ordered() {
  int shared = 0;
  one_after_the_other([&] { shared = 1; }, [&] { shared = 2; });
}
void write_then_read() {
  int shared = 0, seen = 0;
  together([&] { shared = 1; },
           [&] {
             this_thread::sleep_for(1ms);
             seen = shared;
           });
}
void read_then_write() {
  int shared = 0, seen = 0;
  together([&] { seen = shared; },
           [&] {
             this_thread::sleep_for(1ms);
             shared = 1;
           });
}
void read_read() {
  int shared = 7, first = 0, second = 0;
  together([&] { first = shared; }, [&] { second = shared; });
}
void many_readers_one_writer() {
  int shared = 7;
  std::array<int, 8> seen{};
  std::vector<thread> readers;
  for (int& of_one : seen) readers.emplace_back([&] { of_one = shared; });
  shared = 8;
  for (thread& reader : readers) reader.join();
}

// Bytes of one word.
template <std::size_t First, std::size_t Second>
void neighbours() {
  alignas(8) char bytes[16] = {};
  together([&] { bytes[First] = 1; }, [&] { bytes[Second] = 1; });
}
void bits_of_one_byte() {
  struct {
    unsigned a : 3, b : 5;
  } bits = {};
  together([&] { bits.a = 1; }, [&] { bits.b = 1; });
}

// An int across the border of two words, at bytes 6 to 9, and a byte.
template <std::size_t Byte>
void unaligned() {
  struct alignas(8) Record {
    char head[6];
    struct [[gnu::packed]] {
      std::int32_t value;
    } number;
    char tail[6];
  };
  Record record = {};
  together([&] { record.number.value = -1; }, [&] { *(reinterpret_cast<volatile char*>(&record) + Byte) = 1; });
}

template <std::size_t Byte>
void copied_range() {
  std::vector<char> from(100, 'x'), to(200);
  together([&] { std::memcpy(to.data(), from.data(), from.size()); },
           [&] {
             volatile char seen = to[Byte];
             (void)seen;
           });
}
template <std::size_t Byte>
void cleared_range() {
  std::vector<char> bytes(200, 'x');
  std::size_t size = 100;
  together([&] { std::memset(bytes.data(), 0, size); }, [&] { bytes[Byte] = 1; });
}
void read_by_a_copy() {
  std::vector<char> from(100, 'x'), to(100);
  together([&] { std::memmove(to.data(), from.data(), from.size()); }, [&] { from[50] = 'y'; });
}
void struct_copied() {
  struct Large {
    std::array<long, 12> values;
  };
  auto a = std::make_unique<Large>(), b = std::make_unique<Large>();
  together([&] { *a = *b; }, [&] { b->values[7] = 1; });
}

struct Animal {
  [[gnu::noinline]] Animal() {}
  virtual int legs() { return 4; }
};
struct Bird : Animal {
  [[gnu::noinline]] Bird() {}
  int legs() override { return 2; }
};
[[gnu::noinline]] int legs_of(Animal& animal) { return animal.legs(); }

// One task constructs another object in the place of the one that the other calls: it writes the pointer to the table
// of virtual functions.
void made_while_called() {
  alignas(Bird) char place[sizeof(Bird)];
  Animal* const animal = new (place) Animal;
  int seen = 0;
  together([&] { seen = legs_of(*animal); }, [&] { new (place) Bird; });
}
void made_after_calls() {
  alignas(Bird) char place[sizeof(Bird)];
  Animal* const animal = new (place) Animal;
  int seen = 0;
  one_after_the_other([&] { seen = legs_of(*animal); }, [&] { new (place) Bird; });
}

void vector_without_lock() {
  std::vector<int> values;
  values.reserve(2);
  together([&] { values.push_back(1); }, [&] { values.push_back(2); });
}
void vector_under_lock() {
  mutex m;
  std::vector<int> values;
  const auto add = [&] {
    const std::lock_guard guard(m);
    values.push_back(1);
  };
  together(add, add);
}

// One task allocates the memory that another freed.
void memory_used_again() {
  const auto use = [] {
    for (int i = 0; i < 20; ++i) {
      auto p = std::make_unique<std::array<int, 16>>();
      (*p)[static_cast<std::size_t>(i % 16)] = i;
      this_thread::yield();
    }
  };
  together(use, use);
}
void stacks_used_again() {
  for (int i = 0; i < 10; ++i) {
    thread([] {
      volatile int values[100];
      for (volatile int& value : values) value = 1;
    }).detach();
    this_thread::sleep_for(1ms);
  }
}

const std::string& local_static() {
  static const std::string text = "made by whoever comes first, and too long for its own small buffer";
  return text;
}
void local_static_shared() {
  std::size_t first = 0, second = 0;
  together([&] { first = local_static().size(); }, [&] { second = local_static().size(); });
  check(first == second);
}
void references_counted() {
  auto shared = std::make_shared<int>(7);
  const auto copy = [shared] {
    for (int i = 0; i < 5; ++i) {
      const std::shared_ptr<int> own = shared;
      this_thread::yield();
    }
  };
  shared = nullptr;
  together(copy, copy);
}

constexpr Program programs[] = {
    {"write_write", write_write, true},
    {"write_write_ordered", write_write_ordered, false},
    {"write_then_read", write_then_read, true},
    {"read_then_write", read_then_write, true},
    {"read_read", read_read, false},
    {"many_readers_one_writer", many_readers_one_writer, true},
    {"the_same_byte", neighbours<3, 3>, true},
    {"neighbouring_bytes", neighbours<3, 4>, false},
    {"neighbouring_words", neighbours<7, 8>, false},
    {"bits_of_one_byte", bits_of_one_byte, true},
    {"unaligned_first_byte", unaligned<6>, true},
    {"unaligned_last_byte", unaligned<9>, true},
    {"before_unaligned", unaligned<5>, false},
    {"behind_unaligned", unaligned<10>, false},
    {"copied_range", copied_range<99>, true},
    {"behind_copied_range", copied_range<100>, false},
    {"cleared_range", cleared_range<99>, true},
    {"behind_cleared_range", cleared_range<100>, false},
    {"read_by_a_copy", read_by_a_copy, true},
    {"struct_copied", struct_copied, true},
    {"made_while_called", made_while_called, true},
    {"made_after_calls", made_after_calls, false},
    {"vector_without_lock", vector_without_lock, true},
    {"vector_under_lock", vector_under_lock, false},
    {"memory_used_again", memory_used_again, false},
    {"stacks_used_again", stacks_used_again, false},
    {"local_static_shared", local_static_shared, false},
    {"references_counted", references_counted, false},
};

}  // namespace

std::span<const Program> plain_programs() { return programs; }

void count_twice_without_lock() {
  auto count = std::make_unique<int>(0);
  const auto increment = [&] { *count = *count + 1; };
  together(increment, increment);
  check(*count == 2, "an increment is lost");
}

// A reader of both must find both or none. Each thread accesses each variable once: a first access cannot be
// distinguished from one to private memory.
void publish_in_two_steps() {
  auto first = std::make_unique<int>(0), second = std::make_unique<int>(0);
  int seen_first = 0, seen_second = 0;
  together(
      [&] {
        *first = 1;
        *second = 1;
      },
      [&] {
        seen_first = *first;
        seen_second = *second;
      });
  check(!(seen_first == 0 && seen_second == 1), "the second is seen without the first");
}

void two_heaps() {
  std::vector<std::unique_ptr<long>> values;
  for (long i = 0; i < 5; ++i) values.push_back(std::make_unique<long>(i));
  mutex m;
  const auto add = [&] {
    for (auto& value : values) {
      const std::lock_guard guard(m);
      *value += 1;
    }
  };
  together(add, add);
}

int planted = 0;
void race_and_lose() {
  auto begun = std::make_unique<int>(0), done = std::make_unique<int>(0);
  atomic<int> value{0};
  const auto increment = [&] {
    *begun = 1;
    const int read = value.load();
    value.store(read + 1);
    *done = 1;
  };
  together(increment, increment);
  check(value.load() == 2, "an update is lost");
}

void write_planted() {
  thread ada({.name = "ada"}, [] { planted = 1; }), bob({.name = "bob"}, [] { planted = 2; });
  ada.join();
  bob.join();
}

}  // namespace waitpoint::races
