"""Throughput of Mitsuba 3 (llvm_ad_rgb) beside build/bench/throughput, one thread each.

Both are measured in turn, round by round and row by row, on batches of the same size, so that other programs on the machine
hit both alike; a ratio is the median over the rounds of the ratio within a round. Compile time is excluded. The same
materials: gold and glass (1.5) of alpha .3 and .2. Mitsuba has no microfacet BSDF with Schlick's Fresnel; beside
ggx_schlick stands its nearest, the conductor. --isa holds both to one vector width, to see what another machine would do.
Run by bench/peers/mitsuba.sh (make bench-peers); --help lists options.
"""

import argparse
import csv
import ctypes
import glob
import os
import statistics
import subprocess
import sys
import time

del sys.path[0]  # the folder of this file, which would be taken for the package of its name

ROUGH = {"alpha_u": 0.3, "alpha_v": 0.2}

# LOBE_ISA of ours: the processor that LLVM is to compile for, and its floats in a vector.
TARGETS = {"avx512": (b"skylake-avx512", 16), "avx2": (b"haswell", 8)}

# Our lobe, and Mitsuba's BSDF.
ROWS = [
    ("lambert", {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.8, 0.5, 0.2]}}),
    ("ggx_conductor", {"type": "roughconductor", "distribution": "ggx", "material": "Au", **ROUGH}),
    ("ggx_schlick", {"type": "roughconductor", "distribution": "ggx", "material": "Au", **ROUGH}),
    ("beckmann_conductor", {"type": "roughconductor", "distribution": "beckmann", "material": "Au", **ROUGH}),
    ("ggx_dielectric", {"type": "roughdielectric", "distribution": "ggx", "int_ior": 1.5, "ext_ior": 1.0, **ROUGH}),
    ("beckmann_dielectric",
     {"type": "roughdielectric", "distribution": "beckmann", "int_ior": 1.5, "ext_ior": 1.0, **ROUGH}),
    ("principled",
     {"type": "principled", "base_color": {"type": "rgb", "value": [0.8, 0.5, 0.2]}, "roughness": 0.4, "metallic": 0.3,
      "anisotropic": 0.3, "specular": 0.5, "spec_tint": 0.2, "sheen": 0.3, "sheen_tint": 0.3, "clearcoat": 0.4,
      "clearcoat_gloss": 0.7, "spec_trans": 0.3}),
]
VERBS = ["sample", "eval", "pdf", "eval+pdf"]


class Peer:
    """One of Mitsuba's BSDFs on n directions over the upper hemisphere."""

    def __init__(self, mi, dr, bsdf, n):
        self.mi, self.dr, self.n = mi, dr, n
        self.bsdf = mi.load_dict(bsdf)
        rng = mi.PCG32(size=n)
        number = rng.next_float32
        self.wo = mi.warp.square_to_uniform_hemisphere(mi.Point2f(number(), number()))
        self.wi = mi.warp.square_to_uniform_hemisphere(mi.Point2f(number(), number()))
        self.u1, self.u2 = number(), mi.Point2f(number(), number())
        dr.eval(self.wo, self.wi, self.u1, self.u2)
        self.rates(1, "sample")

    def once(self, verb):
        si = self.dr.zeros(self.mi.SurfaceInteraction3f, self.n)
        si.wi = self.wo
        ctx = self.mi.BSDFContext()
        if verb == "sample":
            s, weight = self.bsdf.sample(ctx, si, self.u1, self.u2, True)
            self.dr.eval(s.wo, s.pdf, s.sampled_type, weight)
        elif verb == "eval":
            self.dr.eval(self.bsdf.eval(ctx, si, self.wi, True))
        elif verb == "pdf":
            self.dr.eval(self.bsdf.pdf(ctx, si, self.wi, True))
        else:
            self.dr.eval(self.bsdf.eval_pdf(ctx, si, self.wi, True))
        self.dr.sync_thread()

    def rates(self, runs, verb):
        """Median of some runs, in million elements per second."""
        self.once(verb)  # compiles
        rates = []
        for _ in range(runs):
            start = time.perf_counter()
            self.once(verb)
            rates.append(self.n / (time.perf_counter() - start) / 1e6)
        return statistics.median(rates)


def hold_to(dr, isa):
    """Both to one instruction set. Python has no name for Dr.Jit's jit_llvm_set_target(cpu, features, width)."""
    os.environ["LOBE_ISA"] = isa
    core = glob.glob(os.path.join(os.path.dirname(dr.__file__), "libdrjit-core.so*"))
    set_target = ctypes.CDLL(core[0])["_Z19jit_llvm_set_targetPKcS0_j"]
    set_target.argtypes = [ctypes.c_char_p, ctypes.c_char_p, ctypes.c_uint32]
    set_target.restype = None
    set_target(TARGETS[isa][0], None, TARGETS[isa][1])


def ours(lobe, verb, n, runs):
    """The median that our benchmark writes, or None for a lobe that this build does not have."""
    path = "build/peers/ours.csv"
    done = subprocess.run(
        ["build/bench/throughput", "--only", "throughput", "--device", "native:1", "--lobe", lobe, "--verb", verb,
         "--n", str(n), "--runs", str(runs), "--csv", path],
        capture_output=True, text=True, check=False)
    if done.returncode == 2 and "no such lobe" in done.stderr:
        return None
    if done.returncode != 0:
        sys.exit(done.stderr)
    with open(path, newline="", encoding="utf-8") as file:
        return float(next(csv.DictReader(file))["median_melements_per_s"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lobe", help="this lobe of ours only")
    parser.add_argument("--verb", choices=VERBS, help="this verb only")
    parser.add_argument("--n", type=int, default=1 << 20, help="elements of a batch (default %(default)s)")
    parser.add_argument("--rounds", type=int, default=7, help="default %(default)s")
    parser.add_argument("--runs", type=int, default=5, help="of which each round takes the median (default %(default)s)")
    parser.add_argument("--isa", choices=sorted(TARGETS), help="the instruction set of both (default: the widest here)")
    options = parser.parse_args()
    rows = [row for row in ROWS if options.lobe in (None, row[0])]
    if not rows:
        parser.error("no such lobe: " + options.lobe)
    try:
        import drjit as dr
        import mitsuba as mi
        mi.set_variant("llvm_ad_rgb")
        dr.set_thread_count(1)
        if options.isa:
            hold_to(dr, options.isa)
        dr.eval(mi.Float(1.0) + dr.arange(mi.Float, 4))
        dr.sync_thread()
    except Exception as reason:  # whatever keeps Mitsuba from running
        print("bench-peers: skipped: Mitsuba does not run here:", reason)
        return
    print(f"Mitsuba {mi.__version__} (llvm_ad_rgb, {os.path.basename(os.environ.get('DRJIT_LIBLLVM_PATH', 'libLLVM'))})"
          f" and lobe (native:1), one thread each, {options.n} elements, {options.isa or 'the widest vectors'}.")
    print(f"Medians of {options.rounds} rounds in turn, each the median of {options.runs} runs. ratio: lobe over Mitsuba"
          " within a round; range: its least and most.\n")
    print(f"{'lobe':<20} {'Mitsuba has':<23} {'verb':<9} {'Mitsuba':>9} {'lobe':>9} {'ratio':>7} {'range':>13}")
    print(f"{'':<20} {'':<23} {'':<9} {'M/s':>9} {'M/s':>9} {'x':>7} {'x':>13}")
    os.makedirs("out/bench", exist_ok=True)
    with open("out/bench/peers.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["lobe", "verb", "mitsuba_melements_per_s", "lobe_melements_per_s", "ratio", "ratio_min",
                        "ratio_max"])
        for lobe, bsdf in rows:
            peer = Peer(mi, dr, bsdf, options.n)
            name = " ".join([bsdf["type"], bsdf.get("distribution", "")])
            for verb in [options.verb] if options.verb else VERBS:
                theirs, mine = [], []
                for _ in range(options.rounds):
                    theirs.append(peer.rates(options.runs, verb))
                    mine.append(ours(lobe, verb, options.n, options.runs))
                rate = statistics.median(theirs)
                if mine[0] is None:
                    print(f"{lobe:<20} {name:<23} {verb:<9} {rate:9.1f} {'-':>9} {'-':>7} {'-':>13}")
                    table.writerow([lobe, verb, f"{rate:.2f}", "-", "-", "-", "-"])
                    continue
                ratios = [a / b for a, b in zip(mine, theirs)]
                spread = f"{min(ratios):.2f}..{max(ratios):.2f}"
                print(f"{lobe:<20} {name:<23} {verb:<9} {rate:9.1f} {statistics.median(mine):9.1f}"
                      f" {statistics.median(ratios):7.2f} {spread:>13}", flush=True)
                table.writerow([lobe, verb, f"{rate:.2f}", f"{statistics.median(mine):.2f}",
                                f"{statistics.median(ratios):.3f}", f"{min(ratios):.3f}", f"{max(ratios):.3f}"])


if __name__ == "__main__":
    main()
