#compdef fvi
# zsh completion for fvi: options and methods are those that the program itself names.
local -a known
if ((CURRENT == 2)) || [[ $words[CURRENT-1] == help ]]; then
    known=(${(f)"$(fvi help 2>/dev/null | sed -n 's/^[a-z: ]*fvi \([a-z][a-z]*\) .*/\1/p' | sort -u)"})
elif [[ $words[2] == methods || $words[2] == help || $words[2] == -* ]]; then
    return # these take no options
else
    case $words[CURRENT-1] in
    --method) known=(${(f)"$(fvi methods 2>/dev/null | cut -f1)"}) ;;
    --memory) known=(auto direct exponentials) ;;
    --derivative) known=(held caputo rl) ;;
    --format) known=(tsv csv json) ;;
    --potential) known=(harmonic: duffing: pendulum: free chain:) ;;
    --force) known=(none step: cosine: impulse: file:) ;;
    --damping) known=(viscous: spring: power: zener: maxwell: maxwell2: davidson: distributed: havriliak: symbol:) ;;
    --columns) known=(t,x t,x,p,energy t,x,v,a t,x,d1.force t,x,work,balance) ;;
    --reduce) known=('max(x)' 'peak(x)' 'rms(x)' 'mean(x)' 'at(max(x))') ;;
    --of) known=(x p energy); [[ $words[2] == response ]] && known=(receptance mobility accelerance ground moduli) ;;
    -o|--problem|--plot|--snapshot|--system|--checkpoint|--curve|--forces) _files; return ;;
    *) known=(${(f)"$(fvi help $words[2] 2>/dev/null | grep -oE -- '--[a-z0-9-]+' | sort -u)"}) ;;
    esac
fi
compadd -- $known
