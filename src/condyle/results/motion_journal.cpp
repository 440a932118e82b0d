#include "condyle/results/motion_journal.h"

#include "condyle/results/exact_words.h"

namespace condyle {

template <class Door, Is<ContactPlaces> Value>
void members(Door& door, Value& places) {
  door(places.on_B.numbers, places.on_A.numbers);
}
template <class Door, Is<MovingContact> Value>
void members(Door& door, Value& contact) {
  door(contact.places, contact.closed, contact.followed);
}
template <class Door, Is<BodyState> Value>
void members(Door& door, Value& body) {
  door(body.X, body.v, body.omega);
}
template <class Door, Is<NetworkState> Value>
void members(Door& door, Value& state) {
  door(state.t, state.bodies, state.contacts);
}
template <class Door, Is<LineState> Value>
void members(Door& door, Value& line) {
  door(line.length, line.rate, line.force, line.energy, line.dissipation);
}
template <class Door, Is<EnergySum> Value>
void members(Door& door, Value& energy) {
  door(energy.kinetic, energy.gravity, energy.elastic, energy.layers, energy.dissipation,
       energy.driver_power);
}
template <class Door, Is<MotionFrame> Value>
void members(Door& door, Value& frame) {
  door(frame.state, frame.contact_force, frame.contact_gap, frame.contact_point, frame.lines,
       frame.paths, frame.condition_multiplier, frame.energy, frame.dissipated, frame.driver_work);
}
template <class Door, Is<ContactEvent> Value>
void members(Door& door, Value& event) {
  door(event.t, event.contact, event.closing, event.speed);
}
template <class Door, Is<MotionStretch> Value>
void members(Door& door, Value& stretch) {
  door(stretch.frames, stretch.events, stretch.steps, stretch.evaluations, stretch.seconds);
}
template <class Door, Is<LatticeRefinement> Value>
void members(Door& door, Value& refinement) {
  door(refinement.potential, refinement.at);
}

namespace {

constexpr std::string_view kStretchWord = "stretch", kFinerWord = "finer";

/// Reads a line of that word without its hash.
template <class Piece>
bool read_piece(std::string_view line, std::string_view word, Piece& piece) {
  if (!line.starts_with(word)) return false;
  WordTaker take{line.substr(word.size())};
  ExactReader{take}(piece);
  return take.ok && take.rest.empty();
}

bool take_line(std::string_view line, MotionContents& journal) {
  if (!take_seal(line)) return false;
  MotionStretch stretch;
  LatticeRefinement refinement;
  if (read_piece(line, kStretchWord, stretch)) {
    journal.stretches.push_back(std::move(stretch));
    return true;
  }
  if (!read_piece(line, kFinerWord, refinement)) return false;
  journal.refinements.push_back(refinement);
  journal.stretches.clear();
  return true;
}

}  // namespace

std::size_t MotionContents::frames() const {
  std::size_t frames = 0;
  for (const MotionStretch& stretch : stretches) frames += stretch.frames.size();
  return frames;
}

JournalParts motion_parts(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  const MassProperties mass = moving_mass(scene);
  std::string numbers;
  put_word(numbers, mass.mass);
  put_words(numbers, mass.center.data(), 3);
  put_words(numbers, mass.inertia.data(), 9);
  JournalParts parts = run_parts(identity(scene, surfaces), scene);
  parts.push_back({"mass", hash_bytes(numbers),
                   "another mass of the moving body, expected that of its mesh now"});
  parts.push_back(program_part());
  return parts;
}

MotionContents read_motion_journal(const std::filesystem::path& path, const JournalParts& parts) {
  MotionContents journal;
  const std::string text = bytes_of_file(path);
  journal.head = read_journal_head(path.string(), text, kMotionJournal, parts);
  if (!journal.head) return journal;
  journal.whole_bytes = read_journal_lines(
      text, journal.head->bytes, [&](std::string_view line) { return take_line(line, journal); });
  return journal;
}

template <class Piece>
void MotionJournal::append_piece(std::string_view word, const Piece& piece) {
  std::string line(word);
  ExactWriter{line}(piece);
  seal_line(0, line);
  append_line(line);
}

void MotionJournal::append(const MotionStretch& stretch) { append_piece(kStretchWord, stretch); }

void MotionJournal::append(const LatticeRefinement& refinement) {
  append_piece(kFinerWord, refinement);
}

}  // namespace condyle
