import{S as e,b as t,p as n,u as r,w as i,x as a}from"./index-Qc_W3yad.js";var o=class{#e;#t;#n;#r=null;constructor(e,t,n){this.#e=e,this.#t=t,this.#n=n}begin(e){let[t,n]=[this.#t.name,this.#n],i=r(()=>this.#e.act(t,{do:`jog`,axis:n,direction:e,held:!0}));this.#r=i.finally(()=>{this.#r=null}),this.#t.hold(n)}end(){let[e,t]=[this.#t.name,this.#n],n=()=>r(()=>this.#e.act(e,{do:`stop`,axis:t}).catch(()=>this.#e.stop(e))),i=this.#r;this.#t.letGo(t),n(),i&&i.then(n)}},s=i`
  .lamp {
    display: inline-flex;
    align-items: center;
    gap: 5px;
    color: var(--muted);
    font-size: 12px;
    white-space: nowrap;
  }
  .lamp::before {
    content: "";
    width: 11px;
    height: 11px;
    border: 2px solid var(--strong-line);
    border-radius: 50%;
  }
  .lamp.on {
    color: var(--text);
    font-weight: 650;
  }
  .lamp.on::before {
    border-color: var(--ok);
    background: var(--ok);
  }
  .lamp.on.hot::before {
    border-color: var(--error);
    background: var(--error);
  }
`;function c(t,n,r,i=!1){return n==null?a:e`
    <span class="lamp ${n?`on`:``} ${i?`hot`:``}" title="${r}: ${n?`on`:`off`}"
      >${t}<span class="visually-hidden">, ${r} ${n?`on`:`off`}</span></span
    >
  `}var l=class extends t{static properties={disabled:{type:Boolean},label:{type:String},held:{state:!0}};static styles=[n,i`
      button {
        width: 100%;
        min-height: 38px;
        font-size: 15px;
        touch-action: none;
        -webkit-touch-callout: none;
      }
      button[aria-pressed="true"] {
        background: var(--accent);
        color: var(--on-accent);
      }
    `];#e=()=>this.#o();#t=()=>{document.hidden&&this.#o()};constructor(){super(),this.disabled=!1,this.label=``,this.held=!1}connectedCallback(){super.connectedCallback(),window.addEventListener(`blur`,this.#e),window.addEventListener(`pagehide`,this.#e),document.addEventListener(`visibilitychange`,this.#t)}disconnectedCallback(){super.disconnectedCallback(),this.#o(),window.removeEventListener(`blur`,this.#e),window.removeEventListener(`pagehide`,this.#e),document.removeEventListener(`visibilitychange`,this.#t)}updated(){this.disabled&&this.#o()}render(){return e`
      <button
        ?disabled=${this.disabled}
        aria-label=${this.label}
        aria-pressed=${this.held}
        @pointerdown=${this.#n}
        @pointerup=${this.#e}
        @pointercancel=${this.#e}
        @lostpointercapture=${this.#e}
        @contextmenu=${e=>e.preventDefault()}
        @keydown=${this.#r}
        @keyup=${this.#i}
        @blur=${this.#e}
      ><slot></slot></button>
    `}#n(e){e.button===0&&(e.currentTarget.setPointerCapture(e.pointerId),this.#a())}#r(e){e.key===`Escape`&&this.#o(),(e.key===` `||e.key===`Enter`)&&(e.preventDefault(),e.repeat||this.#a())}#i(e){(e.key===` `||e.key===`Enter`)&&this.#o()}#a(){this.held||this.disabled||(this.held=!0,this.dispatchEvent(new Event(`begin`)))}#o(){this.held&&(this.held=!1,this.dispatchEvent(new Event(`end`)))}};customElements.define(`pt-hold`,l);export{s as n,o as r,c as t};