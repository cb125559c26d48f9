# Completion of bash from the --help of a program. Variable: name. "--OPTION FILE" completes files; options whose value is
# a word in small letters, each with a line of its own, complete these words.

/^  --[a-z]/ {
   option = $1
   if (!(option in kind)) { list[++count] = option; kind[option] = "switch"; options = options (count == 1 ? "" : " ") option }
   match($0, /^  --[a-z-]+ ?/)
   value = substr($0, RLENGTH + 1)
   sub(/ .*/, "", value)
   if (value == "") next                                  # a switch, its text in the next column
   kind[option] = value ~ /^FILE/ ? "files" : value ~ /^[a-z]/ ? "words" : "free"
   words[option] = words[option] (words[option] == "" ? "" : " ") value
}

END {
   shell_name = name
   gsub(/[^a-z0-9]/, "_", shell_name)
   print "# Completion of " name " for bash, made from its --help."
   print "_" shell_name "() {"
   print "   case ${COMP_WORDS[COMP_CWORD-1]} in"
   for (i = 1; i <= count; i++) {
      option = list[i]
      if (kind[option] == "switch") continue
      if (kind[option] == "words") action = "COMPREPLY=($(compgen -W '" words[option] "' -- \"$2\"))"
      else if (kind[option] == "files") action = "COMPREPLY=($(compgen -f -- \"$2\"))"
      else action = "COMPREPLY=()"
      print "      " option ") " action "; return ;;"
   }
   print "   esac"
   print "   case $2 in"
   print "      -*) COMPREPLY=($(compgen -W '" options "' -- \"$2\")) ;;"
   print "      *) COMPREPLY=($(compgen -f -X '!*.nml' -- \"$2\") $(compgen -d -- \"$2\")) ;;"
   print "   esac"
   print "}"
   print "complete -o filenames -F _" shell_name " " name
}
