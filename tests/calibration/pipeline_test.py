"""What calibration/pipeline.py makes of disassembled blocks."""
import os
import shutil
import tempfile
import unittest

import pipeline


class ForModel(unittest.TestCase):
    def test_transfers_of_several_registers_are_one_each(self):
        self.assertEqual(pipeline.for_model("push {r4, r5, r6, lr}"), ["str r0, [sp]"] * 4)
        self.assertEqual(pipeline.for_model("pop {r4-r7, pc}"), ["ldr r0, [sp]"] * 5)
        self.assertEqual(pipeline.for_model("ldm r1!, {r0, r2}"), ["ldr r0, [sp]"] * 2)

    def test_calls_and_branches_are_branches(self):
        self.assertEqual(pipeline.for_model("bl #0x10378"), ["b #16"])
        self.assertEqual(pipeline.for_model("bx lr"), ["b #16"])
        self.assertEqual(pipeline.for_model("bne #0x10378"), ["bne #16"])
        self.assertEqual(pipeline.for_model("bleq #0x10378"), ["beq #16"])
        self.assertEqual(pipeline.for_model("ble #0x10378"), ["ble #16"])
        self.assertEqual(pipeline.for_model("bls #0x10378"), ["bls #16"])

    def test_what_only_fills_a_slot_is_nothing(self):
        self.assertEqual(pipeline.for_model("nop"), [])

    def test_others_stay(self):
        for text in ("ldr r2, [sp, #4]", "bic r0, r0, #1", "bfi r1, r2, #3, #4"):
            self.assertEqual(pipeline.for_model(text), [text])


class ReadBlocks(unittest.TestCase):
    def test_blocks_by_number(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "blocks")
            with open(path, "w", encoding="ascii") as file:
                file.write("block 7\nadd r0, r0, #1\nbx lr\nblock 3\nnop \n")
            self.assertEqual(pipeline.read_blocks(path),
                             {7: ["add r0, r0, #1", "bx lr"], 3: ["nop"]})


@unittest.skipUnless(shutil.which("llvm-mca"), "llvm-mca is not installed")
class Cycles(unittest.TestCase):
    def test_divisions_take_longer_than_additions(self):
        cycles, unknown = pipeline.cycles_of_blocks({
            1: ["add r0, r1, r2", "add r3, r4, r5"],
            2: ["vdiv.f64 d0, d0, d1", "vdiv.f64 d0, d0, d1"]})
        self.assertEqual(unknown, set())
        self.assertGreaterEqual(cycles[1], 1)
        self.assertGreater(cycles[2], 20 * cycles[1])

    def test_what_is_not_known_takes_a_cycle(self):
        cycles, unknown = pipeline.cycles_of_blocks({1: ["add r0, r1, r2", "frobnicate r1"]})
        self.assertEqual(unknown, {"frobnicate r1"})
        self.assertGreaterEqual(cycles[1], 2)


if __name__ == "__main__":
    unittest.main()
