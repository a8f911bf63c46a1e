"""How likely a landing has exceeded a limit allowable, given how well it is known."""
