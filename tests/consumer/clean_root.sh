# shellcheck shell=bash
# Sourced by package_test.sh.
#
# make_clean_root FOLDER DEB...: a root that holds those installed packages alone which the DEBs depend on and Debian's
# essential ones, as dpkg has them here, without network: a library that no DEB names is not in it. Needs root. Their own
# scripts do not run; alternatives and the loader's cache are carried over. Returns 1 with a line where it cannot be.
make_clean_root() {
  local root=$1 here
  shift
  here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
  local dpkg=/var/lib/dpkg packages
  packages=$(/usr/bin/python3 "$here/needed_packages.py" "$@") || return 1
  mkdir -p "$root$dpkg"/{info,updates,triggers,parts,alternatives} "$root"/{proc,dev,tmp,run}
  touch "$root$dpkg"/{available,lock}

  # Folders of the merged /usr first: files go through them.
  local folder
  for folder in bin sbin lib lib32 lib64 libx32; do
    [ ! -L "/$folder" ] || { mkdir -p "$root/usr/$folder" && ln -s "usr/$folder" "$root/$folder"; }
  done
  # shellcheck disable=SC2086  # a name has no blanks
  dpkg-query --listfiles $packages | grep '^/' | sort -u | grep -vE '^/(\.|usr/share/(doc|man|locale)/.*|s?bin|lib(32|64|x32)?)?$' >"$root/files"
  # What is diverted, or was thinned out of a small system, is not there.
  tar --create --no-recursion --ignore-failed-read --files-from "$root/files" --directory / 2>/dev/null |
    tar --extract --keep-directory-symlink --directory "$root" || true

  local name list
  for name in $packages; do
    for list in "$dpkg/info/$name".* "$dpkg/info/$name":*; do
      [ ! -e "$list" ] || cp -a "$list" "$root$dpkg/info"
    done
    dpkg-query --status "$name" >>"$root$dpkg/status"
    echo >>"$root$dpkg/status"
  done
  cp -a "$dpkg/info/format" "$root$dpkg/info/" 2>/dev/null || true

  # Links that update-alternatives made, of what is there.
  local link
  mkdir -p "$root/etc/alternatives"
  for link in /etc/alternatives/*; do
    [ ! -e "$root$(readlink -f "$link")" ] || cp -a "$link" "$root/etc/alternatives"
  done
  find /usr/lib /usr/bin -maxdepth 2 -lname '/etc/alternatives/*' | while read -r link; do
    [ ! -L "$root/etc/alternatives/$(basename "$(readlink "$link")")" ] || cp -a "$link" "$root$link" 2>/dev/null || true
  done
  cp /etc/passwd /etc/group "$root/etc"
  [ -e "$root/dev/null" ] || mknod -m 666 "$root/dev/null" c 1 3 || return 1
  chroot "$root" ldconfig || return 1
}
