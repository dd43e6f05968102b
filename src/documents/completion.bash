# Completions of asdf-vk and asdf-vk-generate for bash: the options of their help, and the names of values.
_asdf_vk() {
  local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} help words
  # Bash splits --name=value into three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  COMPREPLY=()
  [[ " ${COMP_WORDS[*]:1:COMP_CWORD - 1} " == *' -- '* ]] && return
  help=$("${COMP_WORDS[0]}" --help=all 2>/dev/null)
  words=$(sed -nE "s/^  (-.,)?$option(\[=| )([^] ]*\|[^] ]*).*/\3/p" <<<"$help" | tr '|' '\n' | grep -x -- '-*[a-z-]*')
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [[ ${#COMPREPLY[@]} -eq 0 && $current == -* ]]; then
    words=$(sed -nE 's/^  (-[^ []*).*/\1/p' <<<"$help" | tr , ' ')
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}
complete -o default -F _asdf_vk asdf-vk asdf-vk-generate
