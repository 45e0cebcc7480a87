# bash completion for fvi: options and methods are those that the program itself names.
_fvi()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} known=
    COMPREPLY=()
    if ((COMP_CWORD == 1)) || [[ $before == help ]]; then
        known=$(fvi help 2>/dev/null | sed -n 's/^[a-z: ]*fvi \([a-z][a-z]*\) .*/\1/p' | sort -u)
    elif [[ ${COMP_WORDS[1]} == methods || ${COMP_WORDS[1]} == help || ${COMP_WORDS[1]} == -* ]]; then
        return # these take no options
    else
        case $before in
        --method) known=$(fvi methods 2>/dev/null | cut -f1) ;;
        --memory) known='auto direct exponentials' ;;
        --derivative) known='held caputo rl' ;;
        --format) known='tsv csv json' ;;
        --potential) known='harmonic: duffing: pendulum: free chain:' ;;
        --force) known='none step: cosine: impulse: file:' ;;
        --damping) known='viscous: spring: power: zener: maxwell: maxwell2: davidson: distributed: havriliak: symbol:' ;;
        --columns) known='t,x t,x,p,energy t,x,v,a t,x,d1.force t,x,work,balance' ;;
        --reduce) known='max(x) peak(x) rms(x) mean(x) at(max(x))' ;;
        --of) known='x p energy'; [[ ${COMP_WORDS[1]} == response ]] && known='receptance mobility accelerance ground moduli' ;;
        -o | --problem | --plot | --snapshot | --system | --checkpoint | --curve | --forces) COMPREPLY=($(compgen -f -- "$word")); return ;;
        *) known=$(fvi help "${COMP_WORDS[1]}" 2>/dev/null | grep -oE -- '--[a-z0-9-]+' | sort -u) ;;
        esac
    fi
    COMPREPLY=($(compgen -W "$known" -- "$word"))
}
complete -o default -F _fvi fvi
