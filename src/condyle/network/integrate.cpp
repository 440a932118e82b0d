#include "condyle/network/integrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/network/contact_changes.h"
#include "condyle/network/moving_network.h"
#include "condyle/network/record_motion.h"

namespace condyle {
namespace {

constexpr double kBeforeJump = 1e-12;  // [s]: a step may not see a driver after its jump
constexpr double kLook = 2e-3;         // [s]: between detections, however seldom frames are stored

/// From frame to frame, and from event to event between them.
class Integration {
 public:
  Integration(const Network& network,
              NetworkState start,
              const IntegrationOptions& options,
              ContactDetection detect,
              const MotionKeeping& keeping)
      : options_(options),
        keeping_(keeping),
        detect_(std::move(detect)),
        touch_(1e-5 / 30 * network.length),
        moving_(network, std::move(start), options) {
    std::sort(options_.breaks.begin(), options_.breaks.end());
  }

  Motion run() {
    moving_.check_start();
    const bool begins = moving_.change_contacts({}, {}, motion_.events);
    if (detect_) detect_(moving_.state());
    double t = moving_.state().t;
    start_ = t;
    end_ = start_ + options_.end;
    moving_.restart(t);
    store(t);
    frames_ = static_cast<long>(std::ceil(options_.end / options_.interval - 1e-9));
    motion_.completed = true;
    if (!begins) end_at_touch(t);
    begin_stretch();
    take_over();
    t = moving_.state().t;
    for (long k = frames_known() + 1; k <= frames_ && motion_.completed; ++k) {
      const double to = std::min(end_, start_ + static_cast<double>(k) * options_.interval);
      steps_before_ = moving_.ode().steps();
      if (detect_ ? advance_by_looks(t, to) : advance(t, to) && land(t)) store(t);
      if (motion_.completed && k < frames_ && stretch_steps() >= options_.stretch) end_stretch();
      tell_frame(k);
    }
    motion_.steps = steps_of_others_ + moving_.ode().steps();
    motion_.evaluations = evaluations_of_others_ + moving_.ode().evaluations();
    return std::move(motion_);
  }

 private:
  void go_back(const MovingNetwork::Moment& moment, std::size_t events) {
    moving_.go_back(moment);
    motion_.events.resize(events);
    motion_.completed = true;
    motion_.reason.clear();
    hopeless_ = false;
  }

  /// Those after the first.
  [[nodiscard]] long frames_known() const { return static_cast<long>(motion_.frames.size()) - 1; }
  void tell_frame(long frame) const {
    if (options_.on_frame) options_.on_frame(static_cast<int>(frame), static_cast<int>(frames_));
  }

  [[nodiscard]] long stretch_steps() { return moving_.ode().steps() - stretch_.steps; }
  void begin_stretch() {
    stretch_ = {motion_.frames.size(), motion_.events.size(), moving_.ode().steps(),
                moving_.ode().evaluations(), Clock::now()};
  }
  /// At a frame: from here on as if nothing were known but it.
  void begin_anew() {
    moving_.begin_anew(motion_.frames.back());
    if (keeping_.forget) keeping_.forget();
    begin_stretch();
  }
  void end_stretch() {
    const auto from = [](const auto& all, std::size_t first) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
    };
    if (keeping_.on_stretch)
      keeping_.on_stretch({from(motion_.frames, stretch_.frame),
                           from(motion_.events, stretch_.event), stretch_steps(),
                           moving_.ode().evaluations() - stretch_.evaluations,
                           std::chrono::duration<double>(Clock::now() - stretch_.time).count()});
    begin_anew();
  }
  /// The stretches of an earlier run.
  void take_over() {
    for (const MotionStretch& stretch : keeping_.earlier) {
      for (const MotionFrame& frame : stretch.frames) {
        if (!is_of_motion(frame, motion_.frames.front()) || frames_known() + 1 >= frames_)
          refuse_earlier();
        add_frame(frame, motion_);
      }
      for (const ContactEvent& event : stretch.events) {
        if (event.contact < 0 ||
            event.contact >= static_cast<int>(motion_.frames.front().state.contacts.size()))
          refuse_earlier();
        motion_.events.push_back(event);
      }
      steps_of_others_ += stretch.steps;
      evaluations_of_others_ += stretch.evaluations;
    }
    if (keeping_.earlier.empty()) return;
    begin_anew();
    tell_frame(frames_known());
  }
  [[noreturn]] static void refuse_earlier() {
    throw InputError(
        "network: the frames to go on from are of another motion, expected those of an earlier run "
        "of "
        "this one");
  }

  [[nodiscard]] double next_look(double t) const {
    constexpr double kRounding = 1e-6;
    return start_ + kLook * (std::floor((t - start_) / kLook + kRounding) + 1);
  }

  bool advance_by_looks(double& t, double to) {
    while (t < to - 2 * kBeforeJump) {
      attempts_ = 0;
      if (!advance_detecting(t, std::min(to, next_look(t)), 0)) return false;
    }
    return true;
  }

  /// Goes on in halves where the way led into an overlap that no contact saw, or where a contact
  /// was lost.
  bool advance_detecting(double& t, double to, int halvings) {
    constexpr int kMostHalvings = 12, kMostAttempts = 200;
    const MovingNetwork::Moment before = moving_.moment(t);
    const std::size_t events_before = motion_.events.size();
    ++attempts_;
    if (advance(t, to) && land(t)) {
      const DetectedContacts detected = detect_(moving_.state());
      if (!detected.lost.empty()) return end_here(t, detected.lost);
      if (detected.unseen >= 0 && detected.overlapping.empty()) return true;
      if (detected.unseen >= 0 && detected.followed > -touch_)
        return handle_event(t, detected.overlapping, {});
      give_up(
          t,
          "the bodies overlap where no contact could be followed, as beyond the edge of a surface");
    }
    if (hopeless_ || halvings == kMostHalvings || attempts_ >= kMostAttempts) return false;
    go_back(before, events_before);
    t = before.t;
    const double middle = t + (to - t) / 2;
    return advance_detecting(t, middle, halvings + 1) && advance_detecting(t, to, halvings + 1);
  }

  bool advance(double& t, double to) {
    constexpr int kMostEvents = 1000;
    for (int events = 0; t < to - 2 * kBeforeJump;) {
      if (steps_are_spent()) return end_here(t, "too many steps for one frame");
      const double jump = next_jump(t), stop = std::min(end_, jump - kBeforeJump);
      if (stop <= t) {  // just before a jump: go on behind it
        t = jump;
        events = 0;
        if (!handle_event(t, {}, {})) return false;
        continue;
      }
      const OdeOutcome outcome = moving_.ode().advance(t, std::min(to, stop), stop);
      if (outcome == OdeOutcome::kEvent) {
        if (++events > kMostEvents) return end_here(t, "contacts open and close without end");
        if (!handle_root(t)) return false;
      }
      if (outcome != OdeOutcome::kFailed) continue;
      if (steps_are_spent()) return end_here(t, moving_.ode().reason());
      return give_up(t, moving_.lost_contact().value_or(moving_.ode().reason()));
    }
    return true;
  }

  bool steps_are_spent() { return moving_.ode().steps() - steps_before_ >= options_.most_steps; }

  /// The next time after t at which a driver jumps, or never.
  [[nodiscard]] double next_jump(double t) const {
    const auto next = std::upper_bound(options_.breaks.begin(), options_.breaks.end(), t);
    return next == options_.breaks.end() ? INFINITY : *next;
  }

  bool give_up(double t, const std::string& reason) {
    motion_.completed = false;
    motion_.reason = fmt::format("at {:.6g} s: {}", t, reason);
    return false;
  }
  /// Trying again in halves would not help.
  bool end_here(double t, const std::string& reason) {
    hopeless_ = true;
    return give_up(t, reason);
  }

  bool end_at_touch(double t) {
    return end_here(t, fmt::format("more than {} contacts touch at one moment", kMostTouching));
  }

  /// The state at t exactly on the constraints: between steps it is interpolated.
  bool land(double t) { return moving_.land(t) || give_up(t, "the constraints could not be met"); }

  /// Closed contacts whose force has vanished are released, open ones whose gap has are struck.
  bool handle_root(double t) {
    std::vector<int> struck, released;
    for (const int contact : moving_.found())
      (moving_.state().contacts[contact].closed ? released : struck).push_back(contact);
    return handle_event(t, struck, released);
  }

  /// Contacts change where a root was found, or may where a driver jumps.
  bool handle_event(double t, const std::vector<int>& struck, const std::vector<int>& released) {
    if (!land(t)) return false;
    if (!moving_.change_contacts(struck, released, motion_.events)) return end_at_touch(t);
    moving_.restart(t);
    return true;
  }

  void store(double t) {
    if (!moving_.record(motion_)) give_up(t, "the constraints could not be met");
  }

  using Clock = std::chrono::steady_clock;
  /// What there was where a stretch began.
  struct StretchBegin {
    std::size_t frame = 0, event = 0;
    long steps = 0, evaluations = 0;
    Clock::time_point time = {};
  };

  IntegrationOptions options_;  ///< its breaks in order
  const MotionKeeping& keeping_;
  ContactDetection detect_;
  double touch_;  ///< overlap of a contact that opened for nothing [mm]
  MovingNetwork moving_;
  Motion motion_;
  double start_ = 0, end_ = 0;
  long frames_ = 0;  ///< to come, after the first
  StretchBegin stretch_;
  long steps_of_others_ = 0, evaluations_of_others_ = 0;  ///< of an earlier run
  long steps_before_ = 0;                                 ///< this frame
  int attempts_ = 0;                                      ///< to come to this look
  bool hopeless_ = false;
};

}  // namespace

Motion integrate(const Network& network,
                 NetworkState start,
                 const IntegrationOptions& options,
                 ContactDetection detect,
                 const MotionKeeping& keeping) {
  return Integration(network, std::move(start), options, std::move(detect), keeping).run();
}

}  // namespace condyle
