// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/mailbox.hpp"

namespace waitpoint::genom {
namespace {

// All fields of a letter enter the digest.
std::uint64_t hash(const Letter& letter) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(letter.kind));
  digest.add(static_cast<std::uint64_t>(letter.request) << 32 | letter.send_id);
  digest.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(letter.activity)) << 32 | letter.report);
  letter.payload.add_to(digest);
  return digest.value();
}

}  // namespace

Mailbox::Mailbox(std::string owner) : owner_(std::move(owner)), name_(text_hash(owner_)) {}

bool Mailbox::post(const Letter& letter) {
  {
    const std::lock_guard guard(mutex_);
    const bool awaited = letter.kind != LetterKind::request && (letter.send_id == awaited_ || keeps_replies_);
    if (letters_.size() >= letters_max && !awaited) return false;
    letters_.push_back(letter);
  }
  threads::record(name_, hash(letter));
  event_.release();
  return true;
}

bool Mailbox::take(Letter& letter) {
  const std::lock_guard guard(mutex_);
  if (letters_.empty()) return false;
  letter = letters_.front();
  letters_.pop_front();
  return true;
}

}  // namespace waitpoint::genom
