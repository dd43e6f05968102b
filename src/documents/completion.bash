# Completions of asdf-vk and asdf-vk-generate for bash: commands, the options of their help, and the names of values.
_asdf_vk() {
  local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} help words command=
  local commands='summarize serve mcp'
  [[ ${COMP_WORDS[0]##*/} == asdf-vk ]] || commands=
  # Bash splits --name=value into three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  COMPREPLY=()
  [[ " ${COMP_WORDS[*]:1:COMP_CWORD - 1} " == *' -- '* ]] && return
  [[ $COMP_CWORD -gt 1 && " $commands " == *" ${COMP_WORDS[1]} "* ]] && command=${COMP_WORDS[1]}
  if [[ $COMP_CWORD -eq 1 && -n $current && -n $(compgen -W "$commands" -- "$current") ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current" && compgen -f -- "$current")
    return
  fi
  help=$("${COMP_WORDS[0]}" ${command:+"$command"} --help=all 2>/dev/null)
  words=$(sed -nE "s/^  (-.,)?$option(\[=| )([^] ]*\|[^] ]*).*/\3/p" <<<"$help" | tr '|' '\n' | grep -x -- '-*[a-z-]*')
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [[ ${#COMPREPLY[@]} -eq 0 && $current == -* ]]; then
    words=$(sed -nE 's/^  (-[^ []*).*/\1/p' <<<"$help" | tr , ' ')
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}
complete -o default -F _asdf_vk asdf-vk asdf-vk-generate
