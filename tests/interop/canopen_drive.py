"""Runs a CiA 402 master of the library `canopen`: python canopen_drive.py TTY EDS NODE-ID.

The CAN bus is a serial line with python-can's `slcan` interface. The test simulates the drive at the other end.
"""

import logging
import sys
import time

import canopen
from canopen.profiles.p402 import BaseNode402

from talk import serve

logging.disable(logging.WARNING)

PATIENCE = 20


class Drive:
    """The library's drive, with methods for the commands that the test sends."""

    def __init__(self, tty, eds, node_id):
        self.network = canopen.Network()
        self.network.connect(interface="slcan", channel=tty, bitrate=500_000, sleep_after_open=0)
        self.node = BaseNode402(node_id, eds)
        self.node.sdo.RESPONSE_TIMEOUT = PATIENCE
        for name in ["RESET_FAULT", "SWITCH_OP_MODE", "SWITCH_STATE_FINAL", "SWITCH_STATE_SINGLE", "CHECK_TPDO"]:
            setattr(self.node, f"TIMEOUT_{name}", PATIENCE)
        self.network.add_node(self.node)

    def setup(self):
        """Starts the node. Returns whether the library uses PDOs for the controlword and the statusword."""
        self.node.nmt.state = "PRE-OPERATIONAL"
        # The library waits for a PDO with the statusword and the mode, so the drive must send this PDO periodically.
        self.node.sdo[0x1800][5].raw = 10
        self.node.setup_402_state_machine()
        self.node.nmt.state = "OPERATIONAL"
        return [0x6040 in self.node.rpdo_pointers, 0x6041 in self.node.tpdo_pointers]

    def state(self, state=None):
        """Leads the drive to a state, and returns the state. The library selects the commands."""
        if state is not None:
            self.node.state = state
        return self.node.state

    def wait_state(self, state):
        """Waits until the drive reports a state. Returns the state."""
        return self.wait(lambda: self.node.state == state) and self.node.state

    def mode(self, mode):
        """Changes the mode of operation, and returns the mode that the drive confirms."""
        self.node.op_mode = mode
        return self.node.op_mode

    def move(self, target):
        """Moves to a position in the mode "profile position". Returns the actual position at the end of the move."""
        self.node.sdo[0x607A].raw = target
        self.node.controlword = 0x3F
        if not self.wait(lambda: self.node.statusword & 1 << 12):
            return "the set-point isn't acknowledged"
        self.node.controlword = 0x0F
        if not self.wait(lambda: not self.node.statusword & 1 << 12 and self.node.statusword & 1 << 10):
            return "the target isn't reached"
        return self.node.sdo[0x6064].raw

    def home(self):
        """Executes homing. Returns whether it was successful."""
        return self.node.homing(timeout=PATIENCE)

    def get(self, index, sub):
        """Returns the value of an object."""
        item = self.node.sdo[index]
        return (item[sub] if sub else item).raw

    @staticmethod
    def wait(condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                return False
            time.sleep(0.002)
        return True


def main():
    tty, eds, node_id = sys.argv[1:]
    drive = Drive(tty, eds, int(node_id))
    names = ["setup", "state", "wait_state", "mode", "move", "home", "get"]
    serve({name: getattr(drive, name) for name in names})
    drive.network.disconnect()


main()
