#include "condyle/results/journal_line.h"

#include <cmath>

#include "condyle/math/no_number.h"
#include "condyle/results/journal_words.h"

namespace condyle {
namespace {

constexpr int kElsewhere = 1, kOpen = 2;  // bits of one word

void put_contacts(std::string& out, const std::vector<ContactResult>& contacts) {
  std::size_t points = 0;
  for (const ContactResult& contact : contacts)
    points += contact.closed ? contact.points.size() : 0;
  put_word(out, points);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!contacts[i].closed) continue;
    for (const ContactPointResult& point : contacts[i].points) {
      put_word(out, i);
      put_word(out, point.force);
      put_words(out, point.point_ground.data(), 3);
      put_words(out, point.point_moving.data(), 3);
    }
  }
}

constexpr std::string_view kPaths = " paths";

/// How ligaments lie on what they wrap on.
void put_paths(std::string& out, const std::vector<LigamentPath>& paths) {
  if (paths.empty()) return;
  out += kPaths;
  put_word(out, paths.size());
  for (const LigamentPath& path : paths) {
    put_word(out, path.touches.size());
    for (const LineTouch& touch : path.touches) {
      put_word(out, static_cast<int>(touch.touching));
      put_word(out, static_cast<int>(touch.on_moving));
      for (const Eigen::Vector3d* v : {&touch.P, &touch.Q, &touch.t_P, &touch.t_Q, &touch.side})
        put_words(out, v->data(), 3);
      put_word(out, touch.arc);
      put_word(out, touch.turn);
    }
  }
}

void take_paths(WordTaker& take, PoseResult& pose) {
  constexpr std::size_t kMost = 100000;
  if (!take.rest.starts_with(kPaths)) return;
  take.rest.remove_prefix(kPaths.size());
  pose.paths.resize(take.index(kMost));
  for (LigamentPath& path : pose.paths) {
    const std::size_t count = take.index(kMostPathNumbers);
    for (std::size_t k = 0; take.ok && k < count; ++k) {
      LineTouch& touch = path.touches.emplace_back();
      touch.touching = take.index(2) == 1;
      touch.on_moving = take.index(2) == 1;
      for (Eigen::Vector3d* v : {&touch.P, &touch.Q, &touch.t_P, &touch.t_Q, &touch.side})
        take.numbers(v->data(), 3);
      touch.arc = take.number<double>();
      touch.turn = take.number<double>();
    }
  }
}

constexpr std::string_view kTrace = " trace";

void put_trace(std::string& out, const PoseTrace& trace) {
  out += kTrace;
  put_word(out, static_cast<int>(trace.route));
  put_word(out, static_cast<int>(trace.origin));
  for (const int count : {trace.parts, trace.searches, trace.closings, trace.openings})
    put_word(out, count);
  put_word(out, trace.residuals.size());
  put_words(out, trace.residuals.begin(), trace.residuals.size());
}

/// Lines of older runs have none.
void take_trace(WordTaker& take, PoseTrace& trace) {
  if (!take.rest.starts_with(kTrace)) return;
  take.rest.remove_prefix(kTrace.size());
  trace.route = static_cast<PoseRoute>(take.index(kPoseRouteCount));
  trace.origin = static_cast<PoseOrigin>(take.index(kPoseOriginCount));
  for (int* count : {&trace.parts, &trace.searches, &trace.closings, &trace.openings})
    *count = take.number<int>();
  const std::size_t residuals = take.index(ResidualHistory::kMost + 1);
  for (std::size_t k = 0; take.ok && k < residuals; ++k) trace.residuals.add(take.number<double>());
}

void take_contacts(WordTaker& take, std::size_t contacts, PoseResult& pose) {
  pose.contacts.assign(contacts, {});
  const auto points = take.number<std::size_t>();
  for (std::size_t k = 0; take.ok && k < points; ++k) {
    const std::size_t index = take.index(contacts);
    if (!take.ok) return;
    ContactPointResult point;
    point.force = take.number<double>();
    take.numbers(point.point_ground.data(), 3);
    take.numbers(point.point_moving.data(), 3);
    ContactResult& contact = pose.contacts[index];
    contact.closed = true;
    contact.force += point.force;
    contact.points.push_back(point);
  }
}

bool of_ligament(EventKind kind) {
  return kind == EventKind::kTouching || kind == EventKind::kLifting;
}

void take_events(WordTaker& take, std::size_t contacts, KnownPose& known) {
  const double from = take.number<double>();
  known.from = std::isnan(from) ? std::nullopt : std::optional<double>(from);
  const auto events = take.number<std::size_t>();
  for (std::size_t k = 0; take.ok && k < events; ++k) {
    Event event;
    event.value = take.number<double>();
    event.kind = static_cast<EventKind>(take.index(kEventKindCount));
    event.contact = take.number<int>();
    take.ok &= event.contact >= -1 && event.contact < static_cast<int>(contacts);
    if (of_ligament(event.kind)) {
      event.ligament = take.number<int>();
      event.wrap = take.number<int>();
      take.ok &= event.ligament >= 0 && event.wrap >= 0;
    }
    known.events.push_back(event);
  }
}

/// ' "REASON" "REMARK" LENGTH ELSEWHERE'; words may hold quotes, so the remark tells its length. A
/// line of an older run ends with the reason.
bool take_words(std::string_view line, KnownPose& known) {
  constexpr std::size_t kQuotes = 3;  // ' "..."'
  if (!line.ends_with('"')) {
    int elsewhere = 0;
    std::size_t length = 0;
    if (!take_last_word(line, elsewhere) || !take_last_word(line, length) ||
        line.size() < length + 2 * kQuotes)
      return false;
    known.from_elsewhere = (elsewhere & kElsewhere) != 0;
    known.open = (elsewhere & kOpen) != 0;
    known.pose.remark = line.substr(line.size() - length - 1, length);
    line = line.substr(0, line.size() - length - kQuotes);
  }
  if (line.size() < kQuotes) return false;
  known.pose.reason = line.substr(2, line.size() - kQuotes);
  return true;
}

}  // namespace

void write_journal_line(const KnownPose& known, std::string& out) {
  const std::size_t begin = out.size();
  const PoseResult& pose = known.pose;
  out += "pose";
  put_word(out, pose.value);
  put_word(out, known.visit);
  put_word(out, static_cast<int>(pose.status));
  put_word(out, pose.iterations);
  put_word(out, pose.residual);
  put_word(out, pose.seconds);
  put_words(out, pose.X_BA.R.data(), 9);
  put_words(out, pose.X_BA.p.data(), 3);
  put_word(out, pose.conditions.size());
  for (const ConditionResult& condition : pose.conditions) put_word(out, condition.multiplier);
  put_contacts(out, pose.contacts);
  put_word(out, known.from.value_or(kNoNumber));
  put_word(out, known.events.size());
  for (const Event& event : known.events) {
    put_word(out, event.value);
    put_word(out, static_cast<int>(event.kind));
    put_word(out, event.contact);
    if (!of_ligament(event.kind)) continue;
    put_word(out, event.ligament);
    put_word(out, event.wrap);
  }
  put_trace(out, pose.trace);
  put_paths(out, pose.paths);
  out += " \"" + pose.reason + "\" \"" + pose.remark + "\"";
  put_word(out, pose.remark.size());
  put_word(out, (known.from_elsewhere ? kElsewhere : 0) + (known.open ? kOpen : 0));
  seal_line(begin, out);
}

bool read_journal_line(std::string_view line,
                       std::size_t contacts,
                       std::size_t conditions,
                       KnownPose& known) {
  known = KnownPose();
  PoseResult& pose = known.pose;
  constexpr std::string_view kWord = "pose";
  if (!take_seal(line) || !line.starts_with(kWord)) return false;
  WordTaker take{line.substr(kWord.size())};
  pose.value = take.number<double>();
  known.visit = take.number<int>();
  pose.status = static_cast<PoseStatus>(take.index(kPoseStatusCount));
  pose.iterations = take.number<int>();
  pose.residual = take.number<double>();
  pose.seconds = take.number<double>();
  take.numbers(pose.X_BA.R.data(), 9);
  take.numbers(pose.X_BA.p.data(), 3);
  const auto multipliers = take.number<std::size_t>();
  if (!take.ok || (multipliers != conditions && multipliers != 0)) return false;
  pose.conditions.resize(multipliers);
  for (ConditionResult& condition : pose.conditions) condition.multiplier = take.number<double>();
  take_contacts(take, contacts, pose);
  take_events(take, contacts, known);
  take_trace(take, pose.trace);
  take_paths(take, pose);
  return take.ok && take_words(take.rest, known);
}

}  // namespace condyle
