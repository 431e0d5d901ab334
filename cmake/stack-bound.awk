# stack-bound.awk: reads `objdump -t` and `objdump -d` of an image; see stack-bound.sh.
#
# A way through a function is followed with two numbers: the bytes on the stack since its entry,
# `depth`, and those that would be there if SP were what Y is, `frame`; "?" when Y is something else.
# The compiler makes frames of locals by moving SP through Y.

function hex(digits,    value, i) {
    digits = tolower(digits)
    sub(/^0x/, "", digits)
    value = 0
    for (i = 1; i <= length(digits); i++)
        value = value * 16 + index("0123456789abcdef", substr(digits, i, 1)) - 1
    return value
}

function refuse(words) {
    if (!refused)
        printf "%s: %s\n", elf, words > "/dev/stderr"
    refused = 1
    return 0
}

# Where an instruction stands, in words.
function place(at) {
    return sprintf("0x%x in %s", at, called[home[at]])
}

# Without what the compiler appends to the names of copies.
function plain(name) {
    sub(/\.(isra|constprop|part|cold|lto_priv)\..*$/, "", name)
    return name
}

function signed16(value) {
    value = value % 65536
    return value > 32767 ? value - 65536 : value < -32768 ? value + 65536 : value
}

/\*ABS\*\t.* __stack$/ { ram_last = hex(substr($0, 1, 8)) }
/ _end$/               { ram_used = hex(substr($0, 1, 8)) - hex("800100") }

substr($0, 16, 1) == "F" && $1 ~ /^[0-9a-f]+ / { is_function[hex(substr($0, 1, 8))] = 1 }

/^[0-9a-f]+ <.*>:$/ {
    name = $0
    gsub(/^[^<]*<|>:$/, "", name)
    split($0, word, " ")
    start = hex(word[1])
    entry[name] = start
    called[start] = name
    ordered[++names] = start
    next
}

$1 ~ /^ *[0-9a-f]+:$/ && NF >= 3 {
    at = $1
    gsub(/[ :]/, "", at)
    at = hex(at)
    home[at] = start
    last_in[start] = at
    bytes = $2
    gsub(/ /, "", bytes)
    following[at] = at + length(bytes) / 2
    code[at] = $3
    first[at] = second[at] = $4
    gsub(/ /, "", first[at])
    sub(/,.*/, "", first[at])
    sub(/^[^,]*(, *)?/, "", second[at])
    gsub(/ /, "", second[at])
    target[at] = match($0, /; 0x[0-9a-f]+/) ? hex(substr($0, RSTART + 2, RLENGTH - 2)) : \
        $3 ~ /^(jmp|call)$/ ? hex(first[at]) : -1
}

# To be looked at: the instruction at `at`, reached with these two numbers by the function `root`.
function reach(root, at, depth, frame) {
    if (refused || (root, at, depth, frame) in seen)
        return
    seen[root, at, depth, frame] = 1
    if (++visits[root, at] > 16)
        return refuse("the stack grows in a loop at " place(at))
    if (!(at in code))
        return refuse(sprintf("no code at 0x%x, reached by %s", at, called[root]))
    if (depth > own[root])
        own[root] = depth
    waiting[root]++
    wait_at[root, waiting[root]] = at
    wait_depth[root, waiting[root]] = depth
    wait_frame[root, waiting[root]] = frame
}

# `root` calls `callee`, with `depth` bytes on its stack and the return address.
function note_call(root, callee, depth) {
    if (!((root, callee) in call_depth)) {
        callee_of[root, ++calls[root]] = callee
        call_depth[root, callee] = depth
    }
    if (depth > call_depth[root, callee])
        call_depth[root, callee] = depth
}

function call_by_pointer(root, at, depth,    pair, i, n, known) {
    n = split(pointers, pair, " ")
    for (i = 1; i <= n; i++) {
        split(pair[i], known, "=")
        if (plain(called[home[at]]) == known[1])
            for (name in entry)
                if (plain(name) == known[2]) {
                    note_call(root, entry[name], depth + 2)
                    found_pointer[at] = 1
                }
    }
    if (!(at in found_pointer))
        refuse("nobody says whom the pointer is to at " place(at))
}

# The compiler's routine that saves registers and makes a frame: it is jumped to, by how many of 18
# registers are spared, with the frame's size in X and the way back in Z, both set right before.
function save_registers(root, at, depth,    spared, i, value) {
    spared = (target[at] - entry["__prologue_saves__"]) / 2
    for (i = at - 2; code[i] == "ldi"; i -= 2)
        value[first[i]] = hex(second[i])
    depth += 18 - spared + value["r26"] + 256 * value["r27"]
    reach(root, 2 * (value["r30"] + 256 * value["r31"]), depth, depth)
}

# A switch goes where a table in flash says: to any of its function that is not reached otherwise.
function take_switch(root, at, depth, frame) {
    switches[root]++
    switch_at[root, switches[root]] = at
    switch_depth[root, switches[root]] = depth
    switch_frame[root, switches[root]] = frame
}

function finish_switches(root,    i, from, at) {
    for (i = 1; i <= switches[root]; i++) {
        from = home[switch_at[root, i]]
        for (at = from; at <= last_in[from]; at += 2)
            if (at in code && !((root, at) in visits)) {
                reach(root, at, switch_depth[root, i], switch_frame[root, i])
                follow(root)
            }
    }
}

function is_loader(address) {
    return address >= hex("1f800") && !(address in code)
}

function jump(root, at, depth, frame,    routine) {
    if (is_loader(target[at]))
        return
    routine = target[at] in home ? called[home[target[at]]] : ""
    if (routine == "__prologue_saves__")
        save_registers(root, at, depth)
    else if (routine == "__tablejump2__")
        take_switch(root, at, depth, frame)
    else if (target[at] in is_function && target[at] != root && depth == 0)
        note_call(root, target[at], 0) # which returns in its place
    else if (routine != "__epilogue_restores__") # that one returns
        reach(root, target[at], depth, frame)
}

# What an instruction makes of Y, as `frame`.
function frame_after(at, depth, frame,    to, from, what) {
    what = code[at]
    to = first[at]
    from = second[at]
    if (to from ~ /-Y|Y\+$/)
        return "?"
    if (to !~ /^r2[89]$/ || what ~ /^(push|out|cp|cpi|cpc|cpse|tst|st|std|sts|sbrc|sbrs|bst)$/)
        return frame
    if (what == "in" && to == "r28" && from == "0x3d")
        return depth
    if (frame == "?" || (what == "in" && from == "0x3e"))
        return frame
    if (what == "sbiw" || what == "subi")
        return signed16(frame + hex(from))
    if (what == "adiw")
        return signed16(frame - hex(from))
    if (what == "sbci")
        return signed16(frame + 256 * hex(from))
    if (what == "sbc" && from == "r1")
        return frame
    return "?"
}

function step(root, at, depth, frame,    what, next_at) {
    what = code[at]
    next_at = following[at]
    if (what == "sei" && in_handler)
        return refuse("a handler can be interrupted at " place(at))
    if (what == "ret" || what == "reti") {
        if (depth != 0)
            refuse(sprintf("returns with %d bytes on the stack at %s", depth, place(at)))
        return
    }
    if (what == "jmp" || what == "rjmp")
        return jump(root, at, depth, frame)
    if (what == "ijmp")
        return refuse("nobody knows where the jump goes at " place(at))
    if (what == "icall")
        call_by_pointer(root, at, depth)
    else if (what == "rcall" && target[at] == next_at)
        depth += 2 # nobody is called: the cheapest way to reserve two bytes
    else if (what == "call" || what == "rcall")
        note_call(root, target[at], depth + 2)
    else if (what == "push")
        depth++
    else if (what == "pop")
        depth--
    else if (what == "out" && first[at] == "0x3d") {
        if (second[at] != "r28" || frame == "?")
            return refuse("SP is set from nobody knows what at " place(at))
        depth = frame
    } else if (what ~ /^br/)
        reach(root, target[at], depth, frame)
    else if (what ~ /^(cpse|sbrc|sbrs|sbic|sbis)$/)
        reach(root, following[next_at], depth, frame)
    reach(root, next_at, depth, frame_after(at, depth, frame))
}

function follow(root,    i) {
    while (waiting[root] > 0 && !refused) {
        i = waiting[root]--
        step(root, wait_at[root, i], wait_depth[root, i], wait_frame[root, i])
    }
}

# The bytes that the function at `root` needs with all that it calls, without its return address.
function deepest(root,    i, callee, depth, most) {
    if (refused)
        return 0
    if (root in total)
        return total[root]
    if (root in being_followed)
        return refuse("recursion: " called[root] " calls itself, maybe through others")
    being_followed[root] = 1
    reach(root, root, 0, "?")
    follow(root)
    finish_switches(root)
    most = own[root] + 0
    for (i = 1; i <= calls[root]; i++) {
        callee = callee_of[root, i]
        depth = call_depth[root, callee] + deepest(callee)
        if (depth > most) {
            most = depth
            deepest_callee[root] = callee
        }
    }
    delete being_followed[root]
    return total[root] = most
}

function way(root,    words) {
    words = called[root]
    while (root in deepest_callee) {
        words = words sprintf(" (%d) > %s", call_depth[root, deepest_callee[root]], \
            called[deepest_callee[root]])
        root = deepest_callee[root]
    }
    return words sprintf(" (%d)", own[root])
}

END {
    if (!("main" in entry) || ram_last == "" || ram_used == "")
        refuse("no code found in it")
    in_handler = 1
    for (name in entry)
        if (name ~ /^__vector_[0-9]+$/ && deepest(entry[name]) >= of_handler) {
            of_handler = deepest(entry[name])
            handler = entry[name]
        }
    in_handler = 0
    of_main = deepest(entry["main"])
    if (refused)
        exit 1

    bound = 2 + of_main + (handler != "" ? 2 + of_handler : 0)
    left = ram_last - 255 - ram_used - bound
    printf "stack_bound_bytes %d\nram_static_bytes %d\nram_free_bytes %d\n", bound, ram_used, left
    print "way of main: " way(entry["main"])
    if (handler != "")
        print "way of the deepest handler: " way(handler)
    for (i = 1; i <= names; i++)
        if (ordered[i] in total)
            printf "function %s %d %d\n", called[ordered[i]], own[ordered[i]] + 2, \
                total[ordered[i]] + 2
    if (left < 0)
        refuse(sprintf("variables and stack need %d bytes more than there are", -left))
    exit refused
}
