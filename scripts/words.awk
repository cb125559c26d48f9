# Plain English in comments, docstrings and Markdown, for scripts/check-source:   awk -v kinds='KIND ...' -f words.awk FILE...
# Prints a line for each comment that starts with a linking word, and for each kind of text with too many vague words per
# 1,000 words, with the files that have most. Kinds: Fortran, Python and shell comments, docstrings, Markdown.

BEGIN {
   # Vague words, with their limits per 1,000 words.
   limit["what"] = 1.5; limit["that of, those of"] = 0.3; limit["say, tell"] = 0.8; limit["one, ones"] = 4.5
   meaning["what"] = "what"; meaning["one"] = meaning["ones"] = "one, ones"
   meaning["say"] = meaning["says"] = meaning["said"] = meaning["tell"] = meaning["tells"] = meaning["told"] = "say, tell"
   split(kinds, list, " ")
   for (k in list) is_checked[list[k]] = 1
}

FNR == 1 {
   type = FILENAME ~ /\.(f90|F90|inc)$/ ? "Fortran" : FILENAME ~ /\.md$/ ? "Markdown" : FILENAME ~ /\.py$/ ? "Python" : "shell"
   if (type == "shell" && /^#!.*python/) type = "Python"
   in_code = in_docstring = 0
   comment_at = 0   # column of the comment in the line before; 0: none
   last_word = ""
}

type == "Markdown" {
   if (/^ *```/) { in_code = !in_code; next }
   if (in_code || /^    / || /^\|/) next
   gsub(/`[^`]*`/, " ")
   count(type, $0)
   next
}

in_docstring || (type == "Python" && /^[ \t]*[rR]?"""/) {
   text = $0
   if (!in_docstring) {
      sub(/^[ \t]*[rR]?"""/, "", text)
      check_start(text)
   }
   at = index(text, "\"\"\"")
   in_docstring = at == 0
   count("docstrings", at == 0 ? text : substr(text, 1, at - 1))
   comment_at = 0
   next
}

{
   at = type == "Fortran" ? match($0, /!+[<>]?[ \t]/) : match($0, /(^|[ \t])#:?[ \t]/)
   if (at == 0) { comment_at = 0; next }
   if (type != "Fortran" && substr($0, at, 1) != "#") { at++; RLENGTH-- }
   text = substr($0, at + RLENGTH)
   before = substr($0, 1, at - 1)
   if (type == "shell" && before !~ /^[ \t]*$/) { comment_at = 0; next }   # may be a string
   sub(/^[ \t]+/, "", text)
   count(type, text)
   # Quotes before it: a string, perhaps. In the column of the line before: its continuation.
   if (gsub(/["\047]/, "", before) % 2 == 0 && at != comment_at) check_start(text)
   comment_at = at
}

function check_start(text) {
   if (match(text, /^(Of|The same|That|To which|And|What)([ ,.:;]|$)/))
      print FILENAME ":" FNR ": starts with '" substr(text, 1, RLENGTH - (text ~ /[ ,.:;]/)) "': name the thing"
}

function count(kind, text,   n, i, word, found) {
   gsub(/[^A-Za-z\047]+/, " ", text)
   n = split(tolower(text), word, " ")
   words[kind] += n
   for (i = 1; i <= n; i++) {
      found = ""
      if (word[i] in meaning) found = meaning[word[i]]
      else if (word[i] == "of" && (last_word == "that" || last_word == "those")) found = "that of, those of"
      if (found != "") { times[kind, found]++; in_file[kind, found, FILENAME]++ }
      last_word = word[i]
   }
}

END {
   for (kind in is_checked) for (word in limit) {
      rate = words[kind] > 0 ? 1000*times[kind, word]/words[kind] : 0
      if (rate > limit[word]) {
         printf "%s: %.1f times '%s' in 1,000 words, at most %.1f;", kind, rate, word, limit[word]
         for (i = 1; i <= 5; i++) {
            most = ""
            for (key in in_file) {
               split(key, part, SUBSEP)
               if (part[1] == kind && part[2] == word && (most == "" || in_file[key] > in_file[most])) most = key
            }
            if (most == "") break
            split(most, part, SUBSEP)
            printf " %s %d", part[3], in_file[most]
            delete in_file[most]
         }
         print ""
      }
   }
}
