// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/controller.hpp"

#include <algorithm>
#include <iterator>

#include "modules/control/contradictions.hpp"

namespace waitpoint::control {
namespace {
constexpr Duration full_mailbox_period = std::chrono::milliseconds(1);
}

Controller::Controller(Rules rules, genom::NameSpace& names, const genom::TaskComputing& computing)
    : rules_(std::move(rules)),
      names_(names),
      automaton_(rules_),
      bindings_(rules_, automaton_, names),
      computing_(computing),
      log_(names.create_poster<Decision>("control.decision", "control")),
      values_(automaton_.initial_values()),
      requests_(automaton_),
      is_unresolved_(automaton_.checks()) {
  check_contradictions(rules_, automaton_);
  mailbox_.keep_room_for_replies();
  names_.set_gate(this);
}

Controller::~Controller() { names_.set_gate(nullptr); }

void Controller::start() {
  const threads::thread_attributes attributes{.name = "control",
                                              .service = true,
                                              .clock = computing_.clock,
                                              .on = computing_.on,
                                              .priority = computing_.priority};
  threads_.emplace_back(attributes, [this] { run(); });
}

void Controller::stop() {
  stopping_ = true;
  mailbox_.event().release();
  for (threads::thread& thread : threads_) thread.join();
  threads_.clear();
}

bool Controller::post(genom::Module& module, const genom::Letter& request) {
  genom::Letter letter = request;
  letter.module = &module;
  return mailbox_.post(letter);
}

// There is always room: as for replies.
void Controller::withdraw(const genom::Letter& withdrawal) { (void)mailbox_.post(withdrawal); }

void Controller::run() {
  for (;;) {
    wait();
    if (stopping_) return;
    step();
  }
}

void Controller::wait() {
  if (again_) return;
  Time until = bindings_.has_posters() ? next_look_ : Time::max();
  for (const Delayed& delayed : delayed_) until = std::min(until, delayed.until);
  if (const std::optional<Time> change = requests_.next_change(now_)) until = std::min(until, *change);
  if (!letters_.empty()) until = std::min(until, now_ + full_mailbox_period);
  if (until == Time::max()) return mailbox_.event().acquire();
  const Duration left = until - threads::now();
  if (left > Duration()) (void)mailbox_.event().try_acquire_for(std::chrono::nanoseconds(left.ns()));
}

void Controller::step() {
  now_ = threads::now();
  next_look_ = Time() + rules_.period * (now_.since_start() / rules_.period + 1);
  change_ = {};
  bindings_.observe(values_);
  genom::Letter letter;
  if (!std::exchange(again_, false) && mailbox_.take(letter)) {
    switch (letter.kind) {
      case genom::LetterKind::request: take_request(letter); break;
      case genom::LetterKind::withdrawal: take_withdrawal(letter); break;
      default: take_reply(letter);
    }
  }
  requests_.evaluate(change_, now_, values_);
  keep_safe();
  look_at_delayed();
  automaton_.remember(values_);
  threads::compute(rules_.cost);
  send();
}

// --- letters ---

void Controller::take_request(const genom::Letter& letter) {
  ControlledRequest request{.module = letter.module,
                            .letter = letter,
                            .number = ++numbered_,
                            .patterns = bindings_.patterns_of(*letter.module, letter)};
  const Judgement judgement = judge(request);
  for (const std::size_t check : judgement.give_way) interrupt_for(check);
  switch (judgement.verdict) {
    case Verdict::accepted: return accept(std::move(request));
    case Verdict::rejected: return reject(request, judgement.check);
    default: break;
  }
  decide(Verdict::delayed, &request, static_cast<std::ptrdiff_t>(judgement.check));
  delayed_.push_back({std::move(request), now_, now_ + judgement.wait_max, judgement.check});
}

void Controller::take_reply(const genom::Letter& reply) {
  ControlledRequest* const request = requests_.find(reply.send_id);
  if (request == nullptr) return;
  genom::Letter to_client = reply;
  to_client.send_id = request->letter.send_id;
  letters_.emplace_back(request->letter.reply_to, to_client);
  if (reply.kind == genom::LetterKind::intermediate_reply) {
    request->activity = reply.activity;
    if (request->is_interrupted) abort(*request);
    return;
  }
  ended_ = *request;
  requests_.remove(reply.send_id);
  change_.ended = &ended_;
  change_.is_success = reply.report == genom::ok;
}

// Of a request that waits; one that has been accepted or rejected has its reply on the way.
void Controller::take_withdrawal(const genom::Letter& withdrawal) {
  const auto withdrawn = std::find_if(delayed_.begin(), delayed_.end(), [&](const Delayed& delayed) {
    const genom::Letter& letter = delayed.request.letter;
    return letter.reply_to == withdrawal.reply_to && letter.send_id == withdrawal.send_id;
  });
  if (withdrawn == delayed_.end()) return;
  end_here(withdrawn->request, genom::StandardReport::activity_interrupted);
  decide(Verdict::withdrawn, &withdrawn->request, -1);
  delayed_.erase(withdrawn);
}

void Controller::accept(ControlledRequest request) {
  request.accepted = now_;
  genom::Letter to_module = request.letter;
  to_module.send_id = request.number;
  to_module.reply_to = &mailbox_;
  to_module.module = nullptr;
  letters_.emplace_back(&request.module->mailbox(), to_module);
  decide(Verdict::accepted, &request, -1);
  change_.accepted = &requests_.add(request);
}

void Controller::reject(const ControlledRequest& request, std::size_t check) {
  end_here(request, genom::StandardReport::rejected_by_control);
  decide(Verdict::rejected, &request, static_cast<std::ptrdiff_t>(check));
}

// The final reply to a request that does not come to its module.
void Controller::end_here(const ControlledRequest& request, genom::StandardReport report) {
  genom::Letter reply;
  reply.kind = genom::LetterKind::final_reply;
  reply.request = request.letter.request;
  reply.send_id = request.letter.send_id;
  reply.report = request.module->report(report);
  letters_.emplace_back(request.letter.reply_to, reply);
}

// --- decisions ---

Controller::Judgement Controller::judge(const ControlledRequest& request) const {
  AcceptedRequests::Change change = change_;
  change.accepted = &request;
  std::vector<bool> values = values_;
  requests_.evaluate(change, now_, values);
  Judgement judgement;
  for (std::size_t i = 0; i < automaton_.checks(); ++i) {
    const auto raises = [&](std::size_t pattern) { return automaton_.raises(i, pattern); };
    if (std::none_of(request.patterns.begin(), request.patterns.end(), raises)) continue;
    if (!automaton_.is_forbidden(i, values)) continue;
    const Check& check = rules_.checks[i];
    Duration wait_max;
    if (is_of(request, check.delayed)) {
      wait_max = check.delay_max;
    } else if (!check.interrupted.empty() && !is_of(request, check.interrupted)) {
      wait_max = check.interruption_max;
      judgement.give_way.push_back(i);
    } else {
      return {.verdict = Verdict::rejected, .check = i};
    }
    if (judgement.verdict == Verdict::accepted || wait_max < judgement.wait_max) {
      judgement.check = i;
      judgement.wait_max = wait_max;
    }
    judgement.verdict = Verdict::delayed;
  }
  return judgement;
}

bool Controller::is_of(const ControlledRequest& request, const std::vector<RequestPattern>& patterns) const {
  return std::any_of(patterns.begin(), patterns.end(), [&](const RequestPattern& pattern) {
    const std::size_t index = automaton_.index_of(pattern);
    return std::find(request.patterns.begin(), request.patterns.end(), index) != request.patterns.end();
  });
}

void Controller::look_at_delayed() {
  if (delayed_.empty()) return;
  if (change_.accepted != nullptr) {
    again_ = true;
    return;
  }
  for (auto delayed = delayed_.begin(); delayed != delayed_.end();) {
    const Judgement judgement = judge(delayed->request);
    if (judgement.verdict == Verdict::accepted) {
      accept(delayed->request);
      delayed_.erase(delayed);
      again_ = !delayed_.empty();
      return requests_.evaluate(change_, now_, values_);
    }
    for (const std::size_t check : judgement.give_way) interrupt_for(check);
    if (judgement.verdict == Verdict::delayed) {
      delayed->check = judgement.check;
      delayed->until = std::min(delayed->until, delayed->arrival + judgement.wait_max);
    }
    if (judgement.verdict == Verdict::rejected || delayed->until <= now_) {
      reject(delayed->request, judgement.check);
      delayed = delayed_.erase(delayed);
    } else {
      ++delayed;
    }
  }
}

// Interrupts the causes of a forbidden state: the activities that the check names, or the newest one whose end
// suffices, or all that contribute to it.
void Controller::keep_safe() {
  for (std::size_t i = 0; i < automaton_.checks(); ++i) {
    if (!automaton_.is_forbidden(i, values_)) {
      is_unresolved_[i] = false;
      continue;
    }
    std::vector<ControlledRequest*> causes;  // the newest first
    const bool is_named = !rules_.checks[i].interrupted.empty();
    for (auto entry = requests_.running().rbegin(); entry != requests_.running().rend(); ++entry) {
      ControlledRequest& request = entry->second;
      const bool is_activity = request.module->requests()[request.letter.request].kind != genom::RequestKind::control;
      const auto raises = [&](std::size_t pattern) { return automaton_.raises(i, pattern); };
      const bool is_cause = is_named ? is_of(request, rules_.checks[i].interrupted)
                                     : std::any_of(request.patterns.begin(), request.patterns.end(), raises);
      if (is_activity && is_cause) causes.push_back(&request);
    }
    if (causes.empty() && !is_unresolved_[i]) {
      decide(Verdict::unresolved, nullptr, static_cast<std::ptrdiff_t>(i));
      is_unresolved_[i] = true;
    }
    const auto suffices = [&](const ControlledRequest* cause) {
      AcceptedRequests::Change change = change_;
      change.without = {cause->number};
      std::vector<bool> values = values_;
      requests_.evaluate(change, now_, values);
      return !automaton_.is_forbidden(i, values);
    };
    const auto one = is_named ? causes.end() : std::find_if(causes.begin(), causes.end(), suffices);
    if (one != causes.end()) causes = {*one};
    for (ControlledRequest* cause : causes) interrupt(*cause, i);
  }
}

void Controller::interrupt_for(std::size_t check) {
  for (auto& [number, request] : requests_.running())
    if (is_of(request, rules_.checks[check].interrupted)) interrupt(request, check);
}

void Controller::interrupt(ControlledRequest& request, std::size_t check) {
  if (std::exchange(request.is_interrupted, true)) return;
  if (request.activity >= 0) abort(request);
  decide(Verdict::interrupted, &request, static_cast<std::ptrdiff_t>(check));
}

// Without a reply: the final reply of the activity tells of its end.
void Controller::abort(const ControlledRequest& request) {
  genom::Letter letter;
  letter.request = request.module->find_request("Abort")->number;
  letter.payload = genom::Payload(genom::AbortInput{request.activity});
  letters_.emplace_back(&request.module->mailbox(), letter);
}

// --- outputs ---

void Controller::decide(Verdict verdict, const ControlledRequest* request, std::ptrdiff_t check) {
  Decision decision;
  decision.verdict = verdict;
  decision.check = static_cast<std::int32_t>(check);
  std::string text;
  if (request != nullptr) {
    const auto module = names_.modules().find(request->module->name());
    decision.number = request->number;
    decision.module = static_cast<std::uint32_t>(std::distance(names_.modules().begin(), module));
    decision.request = request->letter.request;
    decision.activity = request->activity;
    text = module->first + "." + request->module->requests()[request->letter.request].name + " #" +
           std::to_string(request->number) + " ";
  }
  text += name(verdict);
  if (check >= 0) text += ": " + rules_.checks[static_cast<std::size_t>(check)].name;
  decisions_.emplace_back(decision, text);
}

// A full mailbox of a module rejects the request as a system error; that of a client loses the reply, as in GenoM.
// An abort without a reply is tried again.
void Controller::send() {
  for (auto& [decision, text] : decisions_) {
    decision.date = threads::now();
    log_.write(decision);
    if (watch_ != nullptr) watch_->on(decision, text);
  }
  decisions_.clear();
  std::vector<std::pair<genom::Mailbox*, genom::Letter>> aborts;
  for (auto& [mailbox, letter] : letters_) {
    if (mailbox == nullptr || mailbox->post(letter)) continue;
    if (letter.kind == genom::LetterKind::request && letter.reply_to == nullptr) aborts.emplace_back(mailbox, letter);
    if (letter.reply_to != &mailbox_) continue;
    genom::Letter reply;
    reply.kind = genom::LetterKind::final_reply;
    reply.request = letter.request;
    reply.send_id = letter.send_id;
    reply.report = requests_.find(letter.send_id)->module->report(genom::StandardReport::system_error);
    (void)mailbox_.post(reply);
  }
  letters_ = std::move(aborts);
}

}  // namespace waitpoint::control
