# Compares two texts: numbers (without their signs) by size, what stands between them word by word. Prints the first lines that differ and ends
# with 1. -v within=P: numbers may differ by P %.
function words(text) {
  gsub(/[ \t]+/, " ", text)
  gsub(/-+/, "-", text)  # rulers of tables
  sub(/^ /, "", text)    # indentation
  return text
}
# Splits a line into what[k] before number[k]; the rest of the line is what[n + 1].
function split_line(line, what, number,    n) {
  n = 0
  while (match(line, /[0-9]*\.?[0-9]+(e[-+]?[0-9]+)?/)) {
    n++
    what[n] = words(substr(line, 1, RSTART - 1))
    number[n] = substr(line, RSTART, RLENGTH)
    line = substr(line, RSTART + RLENGTH)
  }
  what[n + 1] = words(line)
  sub(/ $/, "", what[n + 1])
  return n
}
function same_number(a, b, after,    off) {
  if (after ~ /^ ?(µs|us|ms|s)([^a-z]|$)/) return 1
  off = a - b
  return (off < 0 ? -off : off) <= within / 100 * a
}
function same(old, new,    n, m, k, old_words, new_words, old_numbers, new_numbers) {
  n = split_line(old, old_words, old_numbers)
  m = split_line(new, new_words, new_numbers)
  if (n != m) return 0
  for (k = 1; k <= n; k++) {
    if (old_words[k] != new_words[k]) return 0
    if (!same_number(old_numbers[k], new_numbers[k], new_words[k + 1])) return 0
  }
  return old_words[n + 1] == new_words[n + 1]
}
/^[ \t]*$/ { next }
FNR == NR { old[++count] = $0; next }
{
  seen++
  if (seen <= count && same(old[seen], $0)) next
  if (differ++ < 5) printf "  page: %s\n  now:  %s\n", (seen <= count ? old[seen] : "(nothing)"), $0
}
END {
  for (; seen < count; seen++)
    if (differ++ < 5) printf "  page: %s\n  now:  (nothing)\n", old[seen + 1]
  exit differ > 0
}
