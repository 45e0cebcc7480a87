#!/bin/sh
# bare.sh FOLDER   Do the two commands of README.md do what it says on a bare Debian?
#
# Bootstraps a minimal Debian into FOLDER/debian with git, make and a compiler, and with nothing
# else. Clones the last commit into it, types there what README.md says, and compares the tree
# afterwards. What was printed stands in FOLDER/log. A minimal Debian has 2 GB at the end; it is
# removed when all went well.
#
# Status 0: both commands are right. 1: one of them is not. 77: this machine cannot try it, and the
# last line says why. Everything happens in mounts and processes of its own (unshare): when they
# end, however they end, nothing is mounted and nothing runs, so that no rm -rf meets a live /proc.
set -eu

leave_out() { echo "$1"; exit 77; }

try() {
    test "$(id -u)" = 0 || leave_out "only root may bootstrap a Debian"
    command -v debootstrap >/dev/null || leave_out "there is no debootstrap"
    command -v unshare >/dev/null || leave_out "there is no unshare"
    unshare --mount --pid --fork true 2>/dev/null || leave_out "mounts of its own are forbidden here"
    folder=$(mkdir -p "$1" && cd "$1" && pwd)
    # A run that was killed before it had mounts of its own may have left some.
    ! grep -q " $folder/" /proc/self/mountinfo || leave_out "something is mounted below $folder"
    rm -rf --one-file-system "$folder/debian"
    mkdir "$folder/debian"
    git clone -q --no-hardlinks . "$folder/clone.new"
    trap 'rm -rf "$folder/clone.new"' EXIT
    unshare --mount --pid --fork --kill-child sh "$0" --inside "$folder" || exit $?
    rm -rf --one-file-system "$folder/debian"
}

# Where this machine has Debian's packages from, a line each: address, release, label.
archives() {
    apt-get indextargets --format '$(ORIGIN)|$(REPO_URI)|$(RELEASE)|$(LABEL)' 'Created-By: Packages' 2>/dev/null |
        sed -n 's/^Debian|\(.*\)/\1/p' | sort -u
}

bootstrap() {
    archives >"$folder/archives"
    test -s "$folder/archives" || echo 'http://deb.debian.org/debian|stable|Debian' >"$folder/archives"
    first=$(awk -F'|' '$3 == "Debian" && $2 !~ /-/ { print $1, $2; exit }' "$folder/archives")
    address=${first% *} release=${first#* }
    # The chroot asks by the roads that this machine asks by: its proxy, its names, its certificates.
    apt-config dump | grep -E '^Acquire::(https?|ftp|Check-)' >"$folder/roads" || true
    eval "$(apt-config shell road Acquire::http::Proxy)"
    export http_proxy="${http_proxy:-${road:-}}"
    test -n "$http_proxy" || unset http_proxy
    debootstrap --variant=minbase --include=git,make,gcc,libc6-dev,ca-certificates "$release" "$root" "$address" ||
        { tail -3 "$root/debootstrap/debootstrap.log" 2>/dev/null; leave_out "debootstrap could not make a Debian (see $folder/log)"; }
    cp "$folder/roads" "$root/etc/apt/apt.conf.d/90roads"
    awk -F'|' '{ print "deb", $1, $2, "main" }' "$folder/archives" >"$root/etc/apt/sources.list"
    cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
    test ! -e /etc/ssl/certs/ca-certificates.crt || cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    mount -t proc proc "$root/proc"
    mkdir -p "$root/dev/pts" "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
    mount -t tmpfs tmpfs "$root/dev/shm"
}

# Types a command inside the Debian below $root: its home, /root, and /root/course, where the clone stands, are that
# Debian's, not this machine's. Seconds mean nothing on a machine that does other things, too: the tests have ten times theirs.
type_there() {
    echo "\$ $*"
    # shellcheck disable=SC2086
    env -i HOME=/root TERM=dumb PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin CK_TIMEOUT_MULTIPLIER=10 \
        ${http_proxy:+http_proxy="$http_proxy"} chroot "$root" sh -c "cd /root/course && $*"
}

inside() {
    folder=$1 root=$1/debian
    mount --make-rprivate /
    bootstrap
    mv "$folder/clone.new" "$root/root/course"
    chown -R 0:0 "$root/root/course"
    # What stands in the first block of code below the title "Two commands", without its comments.
    sed -n '/^## Two commands/,/^## [^T]/ { /^```sh/,/^```/ { /^```/d; s/ *#.*//; p } }' README.md >"$folder/commands"
    test "$(wc -l <"$folder/commands")" = 2 || { echo "README.md has no two commands"; exit 1; }
    while read -r command; do
        type_there "$command" </dev/null || { echo "on a bare Debian, $command failed"; exit 1; }
    done <"$folder/commands"
    # All that is made stands in build/, and what is committed is made to the byte.
    changed=$(type_there git status --porcelain --ignored --untracked-files=all | sed '1d; /^!! build\//d')
    test -z "$changed" || { echo "the two commands changed the tree:"; echo "$changed"; exit 1; }
    echo "on a bare Debian ($release), both commands do what README.md says, and the tree is as it was"
}

# Each stage is a process of its own, since a function in a condition would not stop at an error.
case ${1-} in
'') echo "bare.sh FOLDER" >&2; exit 2 ;;
--try) try "$2" ;;
--inside) inside "$2" ;;
*) mkdir -p "$1"; status=0
   sh "$0" --try "$1" >"$1/log" 2>&1 || status=$?
   case $status in 0 | 77) tail -1 "$1/log" ;; *) tail -60 "$1/log" ;; esac
   exit $status ;;
esac
