"""What a run leaves behind: frames, film, history, states, summary; and how it is interrupted and taken up again."""
