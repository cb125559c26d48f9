# The --help of a program as a manual page. Variables: name, version. A paragraph "Usage:" is the synopsis, "Exit status:",
# "A minimal ..." and "Keys:" have sections of their own, lines "  --OPTION [VALUE]  text" are options, the rest is
# the description or, after the options, notes.

function plain(text) {
   gsub(/\\/, "\\e", text)
   gsub(/-/, "\\-", text)
   sub(/^[.']/, "\\\\\\&&", text)
   return text
}

function section(title) {
   if (title != current) {
      if (is_verbatim) print ".fi"
      is_verbatim = 0
      print ".SH " title
      current = title
   }
}

function verbatim(text) {
   if (!is_verbatim) print ".nf"
   is_verbatim = 1
   print plain(text)
}

# The first sentence that says what the program does, for apropos.
function begin_page(text,   words) {
   words = text
   sub(/[:.,] .*|\.$/, "", words)
   printf ".TH %s 1 \"\" \"ehlwave %s\" \"User commands\"\n", toupper(name), version
   print ".SH NAME"
   print plain(name) " \\- " plain(tolower(substr(words, 1, 1)) substr(words, 2))
   section("SYNOPSIS")
   for (i = 1; i <= usages; i++) verbatim(usage[i])
   section("DESCRIPTION")
   has_begun = 1
}

/^Keys:$/ { section("KEYS"); next }
current == "KEYS" { verbatim($0); next }
/^$/ { after_blank = 1; in_usage = 0; next }
/^Usage: / { in_usage = 1; sub(/^Usage: /, "") }
in_usage { sub(/^       /, ""); usage[++usages] = $0; next }
!has_begun { begin_page($0) }
/^Exit status:/ { section("EXIT STATUS"); sub(/^Exit status: */, "") }
/^A minimal / { section("EXAMPLE"); sub(/^[^:]*: */, "") }
/^All keys / { section("SEE ALSO") }
current == "EXIT STATUS" || current == "EXAMPLE" { sub(/^ +/, ""); verbatim($0); next }
/^  --[a-z]/ {
   section("OPTIONS")
   match($0, /^  --[a-z-]+( [^ ]+)? */)
   option = substr($0, 3, RLENGTH - 2)
   text = substr($0, RLENGTH + 1)
   sub(/ +$/, "", option)
   print ".TP"
   print ".B " plain(option)
   print plain(text)
   next
}
current == "OPTIONS" && !/^ / { section("NOTES") }
{
   if (after_blank && has_text == current) print ".PP"
   after_blank = 0
   has_text = current
   sub(/^ +/, "")
   print plain($0)
}
